// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/shared_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace kerf::bone {

SharedMemory SharedMemory::make(const char* name) {
    const int fd = memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING);
    // A file that shrinks under a mapping would kill the process that reads it.
    if (fd >= 0) static_cast<void>(fcntl(fd, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_SEAL));
    return of(fd);
}

SharedMemory SharedMemory::of(int fd) {
    SharedMemory memory;
    memory.fd_ = fd;
    return memory;
}

SharedMemory& SharedMemory::operator=(SharedMemory&& other) noexcept {
    std::swap(fd_, other.fd_);
    std::swap(base_, other.base_);
    std::swap(size_, other.size_);
    return *this;
}

SharedMemory::~SharedMemory() {
    unmap();
    if (fd_ >= 0) close(fd_);
}

void SharedMemory::unmap() noexcept {
    if (base_ != nullptr) munmap(base_, size_);
    base_ = nullptr;
    size_ = 0;
}

bool SharedMemory::grow(std::uint64_t bytes) {
    if (bytes <= size_) return true;
    return ftruncate(fd_, static_cast<off_t>(bytes)) == 0 && map(bytes);
}

bool SharedMemory::map(std::uint64_t bytes) {
    if (bytes == size_) return true;
    struct stat about {};
    if (fstat(fd_, &about) != 0 || static_cast<std::uint64_t>(about.st_size) < bytes) return false;
    unmap();
    void* base = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0);
    if (base == MAP_FAILED) return false;
    base_ = static_cast<unsigned char*>(base);
    size_ = bytes;
    return true;
}

}  // namespace kerf::bone
