#include "tools/process/process.hpp"

#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

#include <vtm/image/codec.hpp>
#include "tools/process/heap.hpp"

namespace vtm::tools {

namespace {

void openMissingDescriptors() {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor)
        // O_PATH: neither read() nor write() work on it. The least free number is the one that is missing.
        if (fcntl(descriptor, F_GETFD) == -1 && open("/", O_PATH) != descriptor)
            std::abort();
}

extern "C" void endBySignal(int signal) {
    vtm::image::removeTemporaries();
    raise(signal);  // the handler is gone: SA_RESETHAND
}

/// Unless it is ignored already, as nohup does.
void handle(int signal) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN)
        return;
    action.sa_handler = endBySignal;
    action.sa_flags = int(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
}

}  // namespace

void prepareProcess() {
    openMissingDescriptors();
    prepareHeap();
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU})
        handle(signal);
}

}  // namespace vtm::tools
