#include "cores.hpp"

#include <sched.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>
#include <utility>

namespace granum::app
{
int cores()
{
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return 1;

    // Two hardware threads of one core share what a rank is limited by, so they count once.
    std::set<std::pair<int, int>> found;
    std::ifstream cpuinfo("/proc/cpuinfo");
    int processor = -1, socket = 0;
    for (std::string line; std::getline(cpuinfo, line);) {
        auto const colon = line.find(':');
        if (colon == std::string::npos || colon + 2 > line.size()) continue;
        auto const value = [&] { return std::atoi(line.c_str() + colon + 1); };
        if (line.starts_with("processor")) processor = value();
        if (line.starts_with("physical id")) socket = value();
        if (line.starts_with("core id") && processor >= 0 && CPU_ISSET(processor, &allowed))
            found.insert({socket, value()});
    }
    return std::max(1, found.empty() ? CPU_COUNT(&allowed) : static_cast<int>(found.size()));
}
}
