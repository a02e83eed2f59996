// SPDX-License-Identifier: Apache-2.0
// kerf-remesh: runs one remeshing strategy in a process of its own. `kerf` starts it; no other program loads
// strategies.
#include <fcntl.h>

#include <cstdio>

#include "app/request_memory.h"
#include "bone/remesh/remesh_channel.h"
#include "bone/remesh/remesh_server.h"

int main(int argc, char** argv) {
    if (argc != 3 || fcntl(kerf::bone::remesh_channel::socket_fd, F_GETFD) < 0) {
        std::fputs("kerf-remesh is started by kerf. Write `kerf remesh SESSION.db`.\n", stderr);
        return 2;
    }
    return kerf::bone::serve_remeshing(argv[1], argv[2], kerf::app::begin_request_memory,
                                       kerf::app::end_request_memory);
}
