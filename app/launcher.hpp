// Starts the ranks of a run as processes of their own and stands between them and the keyboard.
#pragma once

#include <string>
#include <vector>

namespace granum::app
{
//! Runs this program with `arguments` on `ranks` ranks and waits. The first SIGINT or SIGTERM asks the ranks to stop at
//! their next step, the second ends them at once. Returns the exit status that the ranks agreed on, 130 after a second
//! signal. Throws base::IoError where the ranks cannot be started.
int launch_ranks(int ranks, std::vector<std::string> const& arguments);

//! True in a process that launch_ranks started.
bool started_by_launcher();

//! The status that the launcher shall return; of several ranks that speak, the first is heard. Returns whether this was
//! it.
bool tell_launcher(int status);
}
