// Share of the droplets in a granule's way that strike it, with coefficients by range of the Reynolds number.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/capture/flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace granum::law::capture
{
struct Loeffler
{
    static constexpr base::Card card{.name = "loeffler",
                                     .title = "Loeffler, as used by Uhlemann and Moerl",
                                     .source =
                                         "Loeffler, Staubabscheiden (1988); Uhlemann, Moerl, "
                                         "Wirbelschicht-Spruehgranulation (2000) (recalled, unverified)",
                                     .valid = "one granule; the ranges are joined by short blends of ours"};

    double operator()(Flow const& flow) const
    {
        if (flow.stokes <= 0) return 0;
        double efficiency = of(ranges[0], flow.stokes);
        for (std::size_t i = 0; i < joints.size(); ++i) {
            auto const [begin, end] = joints[i];
            double const into = std::log(std::max(flow.reynolds, 1e-12) / begin) / std::log(end / begin);
            if (into <= 0) break;
            efficiency += std::min(into, 1.0) * (of(ranges[i + 1], flow.stokes) - efficiency);
        }
        return efficiency;
    }

  private:
    struct Range
    {
        double a, b;
    };
    static constexpr std::array<Range, 5> ranges{{{0.65, 3.7}, {1.24, 1.95}, {1.03, 2.07}, {0.84, 2.0}, {0.25, 2.0}}};

    //! Reynolds numbers between which one range passes into the next. The sources leave 90 to 190 open; the others are
    //! a tenth about the limits 1, 30 and 50, so that no droplet meets a jump.
    static constexpr std::array<std::array<double, 2>, 4> joints{{{0.9, 1.1}, {27, 33}, {45, 55}, {90, 190}}};

    static double of(Range const& range, double stokes) { return std::pow(stokes / (stokes + range.a), range.b); }
};
}
