#include "granum/grid/axis.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace granum::grid
{
namespace
{
constexpr double alike = 1e-9;  // widths that differ by less, relatively, are one
constexpr int bins_per_cell = 4;
}

Axis::Axis(std::vector<double> const& faces, bool periodic, int shift, int n)
{
    int const all = static_cast<int>(faces.size()) - 1;
    base::require(all >= 1 && n >= 0 && shift >= 0 && shift + n <= all, "{} cells from cell {} on, of {} in all", n,
                  shift, all);
    for (int i = 0; i < all; ++i)
        base::require(faces[static_cast<std::size_t>(i) + 1] > faces[static_cast<std::size_t>(i)],
                      "faces of cells must rise: {} m is followed by {} m", faces[static_cast<std::size_t>(i)],
                      faces[static_cast<std::size_t>(i) + 1]);
    double const length = faces.back() - faces.front();
    auto const at = [&](int i) {
        if (i >= 0 && i <= all) return faces[static_cast<std::size_t>(i)];
        if (periodic)
            return i < 0 ? faces[static_cast<std::size_t>(i + all)] - length
                         : faces[static_cast<std::size_t>(i - all)] + length;
        return i < 0 ? 2 * faces.front() - faces[static_cast<std::size_t>(-i)]
                     : 2 * faces.back() - faces[static_cast<std::size_t>(2 * all - i)];
    };
    for (int i = shift - 1; i <= shift + n + 1; ++i) faces_.push_back(at(i));
    double const width = length / all;
    for (int i = 0; i < all; ++i)
        uniform_ = uniform_ && std::abs(faces[static_cast<std::size_t>(i) + 1] - faces[static_cast<std::size_t>(i)] -
                                        width) < alike * width;
    first_ = face(0);
    per_width_ = 1 / width;
    if (uniform_ || n == 0) return;
    bins_per_length_ = bins_per_cell * n / (face(n) - face(0));
    for (int bin = 0, i = 0; bin <= bins_per_cell * n; ++bin) {
        while (i + 1 < n && face(i + 1) <= first_ + bin / bins_per_length_) ++i;
        first_in_bin_.push_back(i);
    }
}

int Axis::cell(double x) const
{
    int const n = cells();
    if (x < face(0)) return -1;
    if (x >= face(n)) return n;
    int i = 0;
    if (uniform_)
        i = std::min(static_cast<int>((x - first_) * per_width_), n - 1);
    else
        i = first_in_bin_[static_cast<std::size_t>((x - first_) * bins_per_length_)];
    while (i > 0 && x < face(i)) --i;  // round-off
    while (i + 1 < n && x >= face(i + 1)) ++i;
    return i;
}

double Axis::narrowest() const
{
    double least = width(0);
    for (int i = 1; i < cells(); ++i) least = std::min(least, width(i));
    return least;
}
}
