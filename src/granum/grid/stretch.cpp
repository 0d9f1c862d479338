#include "granum/grid/stretch.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace granum::grid
{
namespace
{
//! Width that a cell at x may have.
double width_at(double x, double coarse, std::vector<Fine> const& fine)
{
    double width = coarse;
    for (auto const& part : fine) {
        double const away = std::max({part.lower - x, x - part.upper, 0.0});
        width = std::min(width, part.size + (part.growth - 1) * away);
    }
    return width;
}
}

std::vector<double> stretched(double low, double high, double coarse, std::vector<Fine> const& fine)
{
    base::require(low < high && coarse > 0, "cells from {} to {} m, {} m wide", low, high, coarse);
    // Pieces between the planes: in each the cells share its length in proportion to the widths that they may have.
    std::vector<double> planes{low, high};
    for (auto const& part : fine) {
        base::require(part.lower < part.upper && part.size > 0 && part.growth > 1, "a fine part from {} to {} m",
                      part.lower, part.upper);
        for (double const x : {part.lower, part.upper})
            if (x > low + 0.25 * part.size && x < high - 0.25 * part.size) planes.push_back(x);
    }
    std::sort(planes.begin(), planes.end());
    std::vector<double> faces{low};
    for (std::size_t p = 0; p + 1 < planes.size(); ++p) {
        double const from = planes[p], to = planes[p + 1];
        if (to - from < 1e-9 * (high - low)) continue;
        // The number of cells that fit is the integral of one over the width.
        constexpr int samples = 2000;
        std::vector<double> passed{0};
        for (int k = 0; k < samples; ++k) {
            double const x = from + (k + 0.5) / samples * (to - from);
            passed.push_back(passed.back() + (to - from) / samples / width_at(x, coarse, fine));
        }
        int const cells = std::max(1, static_cast<int>(std::ceil(passed.back() - 1e-6)));
        for (int i = 1; i < cells; ++i) {
            double const goal = passed.back() * i / cells;
            auto const above = std::upper_bound(passed.begin(), passed.end(), goal);
            auto const k = static_cast<std::size_t>(above - passed.begin()) - 1;
            double const part = (goal - passed[k]) / (passed[k + 1] - passed[k]);
            faces.push_back(from + (static_cast<double>(k) + part) / samples * (to - from));
        }
        faces.push_back(to);
    }
    return faces;
}
}
