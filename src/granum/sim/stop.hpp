// The wish to stop: a signal asks, the time loop answers at the end of its step.
#pragma once

namespace granum::sim
{
//! From now on SIGUSR1 (sent by the program that started the ranks), SIGINT and SIGTERM ask this process to stop.
void install_stop_signals();

//! True once after each SIGUSR2: a checkpoint is wanted, and the run goes on.
bool checkpoint_requested();

//! True once a stop was asked for on this rank. The loop must agree across ranks before it acts on it.
bool stop_requested();
}
