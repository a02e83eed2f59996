// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

namespace kerf {

/// Where the library of a maker may lie.
struct LibraryPlaces {
    std::vector<std::string> names;  ///< of its file, the preferred one first: "libdrd.so.3"
    std::string setting{};           ///< of the station, `library`: a file or a folder; empty: none
    const char* variable = "";       ///< of the environment, with the maker's folder
    const char* maker = "";          ///< for people: "Force Dimension"
};

/// A library of a maker, opened when the driver runs. It stays open until the program ends: closed libraries often keep
/// threads.   [main]
class SharedLibrary {
public:
    /// Opens the first library that can be opened: of the setting, of the variable's folder, then as the system finds
    /// it. Throws std::runtime_error with the reasons if there is none. A setting that names none is not passed over.
    /// @param is_global  its symbols serve the libraries that it opens itself
    SharedLibrary(const LibraryPlaces& places, bool is_global);

    [[nodiscard]] const std::string& file() const noexcept { return file_; }
    /// Sets a pointer to a function. Throws std::runtime_error, with file and symbol, if the library has none.
    template <class F>
    void bind(F*& function, const char* symbol) const {
        function = reinterpret_cast<F*>(address_of(symbol));
    }

private:
    [[nodiscard]] void* address_of(const char* symbol) const;

    void* handle_ = nullptr;
    std::string file_, maker_;
};

/// Returns whether one of the libraries can be opened, without a message.   [main]
[[nodiscard]] bool is_installed(const LibraryPlaces& places);

}  // namespace kerf
