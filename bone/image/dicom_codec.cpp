// SPDX-License-Identifier: Apache-2.0
#include "bone/image/dicom_codec.h"

#include <fcntl.h>
#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fstream>

namespace kerf::bone {
namespace {

constexpr rlim_t max_seconds = 10;                    // of processor time, for one slice
constexpr rlim_t max_memory = 1024ull * 1024 * 1024;  // [bytes] beyond the memory of this process

std::size_t size_of(const DicomSlice& slice) {
    return static_cast<std::size_t>(slice.rows) * static_cast<std::size_t>(slice.columns) *
           static_cast<std::size_t>(slice.bits_allocated / 8);
}

std::vector<char> unpacked(const DicomSlice& slice, const std::vector<std::string>& fragments) {
    gdcm::Image image;
    image.SetNumberOfDimensions(2);
    image.SetDimension(0, static_cast<unsigned>(slice.columns));
    image.SetDimension(1, static_cast<unsigned>(slice.rows));
    image.SetPixelFormat(gdcm::PixelFormat(1, static_cast<unsigned short>(slice.bits_allocated),
                                           static_cast<unsigned short>(slice.bits_stored),
                                           static_cast<unsigned short>(slice.high_bit), slice.is_signed ? 1 : 0));
    image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    image.SetTransferSyntax(gdcm::TransferSyntax::GetTSType(slice.encoding.c_str()));
    const gdcm::SmartPointer<gdcm::SequenceOfFragments> sequence = gdcm::SequenceOfFragments::New();
    for (const std::string& fragment : fragments) {
        gdcm::Fragment piece;
        piece.SetByteValue(fragment.data(), static_cast<std::uint32_t>(fragment.size()));
        sequence->AddFragment(piece);
    }
    gdcm::DataElement element(gdcm::Tag(0x7fe0, 0x0010), 0, gdcm::VR::OB);
    element.SetValue(*sequence);
    image.SetDataElement(element);
    if (image.GetBufferLength() != size_of(slice)) return {};
    std::vector<char> buffer(size_of(slice));
    return image.GetBuffer(buffer.data()) ? buffer : std::vector<char>();
}

/// Returns the memory that this process has mapped [bytes].
rlim_t mapped() {
    std::ifstream in("/proc/self/statm");
    std::uint64_t pages = 0;
    in >> pages;
    return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void limit(int resource, rlim_t largest) {
    const rlimit both{largest, largest};
    setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// Runs in the child process: unpacks the slice, writes all of it or nothing, and exits.
[[noreturn]] void unpack_into(int pipe, rlim_t memory, const DicomSlice& slice,
                              const std::vector<std::string>& fragments) {
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, max_seconds);
    limit(RLIMIT_AS, memory);
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) {  // discards messages of the codecs
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    try {
        gdcm::Trace::DebugOff();
        gdcm::Trace::WarningOff();
        gdcm::Trace::ErrorOff();
        const std::vector<char> pixels = unpacked(slice, fragments);
        for (std::size_t at = 0; at < pixels.size();) {
            const ssize_t count = write(pipe, pixels.data() + at, pixels.size() - at);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) break;
            at += static_cast<std::size_t>(count);
        }
    } catch (...) {
        // An empty pipe reports the failure.
    }
    _exit(0);
}

}  // namespace

bool can_unpack(const std::string& encoding) {
    static constexpr std::array<const char*, 9> known{
        "1.2.840.10008.1.2.5",    "1.2.840.10008.1.2.4.50", "1.2.840.10008.1.2.4.51",
        "1.2.840.10008.1.2.4.57", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80",
        "1.2.840.10008.1.2.4.81", "1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.4.91"};
    return std::find(known.begin(), known.end(), encoding) != known.end();
}

std::vector<char> unpacked_pixels(const DicomSlice& slice, const std::vector<std::string>& fragments) {
    int ends[2];
    const rlim_t memory = mapped() + max_memory;
    if (pipe(ends) != 0) return {};
    const pid_t child = fork();
    if (child < 0) {
        close(ends[0]);
        close(ends[1]);
        return {};
    }
    if (child == 0) {
        close(ends[0]);
        unpack_into(ends[1], memory, slice, fragments);
    }
    close(ends[1]);
    std::vector<char> pixels(size_of(slice));
    std::size_t got = 0;
    while (got < pixels.size()) {
        const ssize_t count = read(ends[0], pixels.data() + got, pixels.size() - got);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        got += static_cast<std::size_t>(count);
    }
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const bool is_whole = got == pixels.size() && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return is_whole ? pixels : std::vector<char>();
}

}  // namespace kerf::bone
