#include "granum/sim/stop.hpp"

#include <array>
#include <csignal>
#include <cstdlib>

namespace granum::sim
{
namespace
{
volatile std::sig_atomic_t asked = 0, checkpoint = 0;

//! The second request from a keyboard ends at once: whoever insists must not wait for the end of a step.
void ask(int signal)
{
    if (asked && signal != SIGUSR1) std::_Exit(130);
    asked = 1;
}

void ask_for_checkpoint(int)
{
    checkpoint = 1;
}
}

void install_stop_signals()
{
    struct sigaction action = {};
    action.sa_handler = ask;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (int const signal : std::array{SIGUSR1, SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
    action.sa_handler = ask_for_checkpoint;
    sigaction(SIGUSR2, &action, nullptr);
}

bool checkpoint_requested()
{
    bool const wanted = checkpoint != 0;
    checkpoint = 0;
    return wanted;
}

bool stop_requested()
{
    return asked != 0;
}
}
