#include "granum/population/classes.hpp"

#include "granum/base/error.hpp"
#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::population
{
Classes Classes::even(double low, double high, std::size_t count)
{
    Classes out;
    for (std::size_t k = 0; k <= count; ++k)
        out.edges.push_back(low + (high - low) * static_cast<double>(k) / static_cast<double>(count));
    out.number.assign(count, 0.0);
    return out;
}

double Classes::surface(std::size_t k) const
{
    double const a = edges[k], b = edges[k + 1];
    return math::pi * (a * a + a * b + b * b) / 3;
}

double Classes::volume(std::size_t k) const
{
    double const a = edges[k], b = edges[k + 1];
    return math::pi / 6 * (a + b) * (a * a + b * b) / 4;
}

void Classes::add(double diameter, double count)
{
    auto const above = std::upper_bound(edges.begin(), edges.end(), diameter);
    base::require(above != edges.begin() && above != edges.end(), "granules of {} m are beyond the classes, {} to {} m",
                  diameter, edges.front(), edges.back());
    number[static_cast<std::size_t>(above - edges.begin()) - 1] += count;
}

double Classes::total() const
{
    double sum = 0;
    for (double const one : number) sum += one;
    return sum;
}

double Classes::total_volume() const
{
    double sum = 0;
    for (std::size_t k = 0; k < size(); ++k) sum += number[k] * volume(k);
    return sum;
}

double Classes::total_surface() const
{
    double sum = 0;
    for (std::size_t k = 0; k < size(); ++k) sum += number[k] * surface(k);
    return sum;
}

double Classes::mean_diameter() const
{
    double sum = 0;
    for (std::size_t k = 0; k < size(); ++k) sum += number[k] * centre(k);
    return sum / total();
}

double Classes::percentile(double share) const
{
    double left = share * total_volume();
    for (std::size_t k = 0; k < size(); ++k) {
        double const here = number[k] * volume(k);
        if (here >= left && here > 0) return edges[k] + width(k) * left / here;
        left -= here;
    }
    return edges.back();
}
}
