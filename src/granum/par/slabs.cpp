#include "granum/par/slabs.hpp"

#include <cstddef>
#include <numeric>

namespace granum::par
{
Slabs Slabs::balanced(double origin, double width, bool periodic, std::vector<double> const& weight, int ranks)
{
    Slabs slabs{.origin = origin, .width = width, .periodic = periodic, .first = {0}};
    int const cells = static_cast<int>(weight.size());
    double const total = std::accumulate(weight.begin(), weight.end(), 0.0);
    double sum = 0;
    int cell = 0;
    for (int rank = 0; rank + 1 < ranks; ++rank) {
        double const goal = total * (rank + 1) / ranks;
        int const last = cells - (ranks - rank - 1);  // leave one cell for each rank after this one
        // A cell goes to this rank while its middle lies before the goal.
        do sum += weight[static_cast<std::size_t>(cell++)];
        while (cell < last && sum + 0.5 * weight[static_cast<std::size_t>(cell)] < goal);
        slabs.first.push_back(cell);
    }
    slabs.first.push_back(cells);
    return slabs;
}
}
