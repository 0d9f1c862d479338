#include "granum/sim/opening_area.hpp"

#include "granum/geometry/open_part.hpp"
#include "granum/sim/build.hpp"

#include <algorithm>

namespace granum::sim
{
namespace
{
constexpr int squares = 48;  // of an opening, in each direction
}

OpeningArea opening_area(Case const& data, OpeningCase const& opening)
{
    std::size_t const d = opening.direction, e = (d + 1) % 3, f = (d + 2) % 3;
    Vec3 low = data.chamber.lower(), high = data.chamber.upper();
    double const depth = 0.02 * (high[d] - low[d]);
    geometry::Beside const beside = opening.upper ? geometry::Beside{depth, 0} : geometry::Beside{0, depth};
    low[d] = high[d] = opening.upper ? high[d] : low[d];
    for (std::size_t const way : {e, f}) {
        if (opening.round) {
            low[way] = std::max(low[way], opening.centre[way] - opening.outer);
            high[way] = std::min(high[way], opening.centre[way] + opening.outer);
        } else if (opening.rectangle) {
            low[way] = std::max(low[way], opening.rectangle->lower[way]);
            high[way] = std::min(high[way], opening.rectangle->upper[way]);
        }
        if (!(low[way] < high[way])) return {0, 0};
    }
    auto even = opening;
    even.parabolic = false, even.rings.clear(), even.holes.clear();
    auto const share = gas_opening(data, even).share;
    double const step_e = (high[e] - low[e]) / squares, step_f = (high[f] - low[f]) / squares;
    OpeningArea out{0, 0};
    for (int j = 0; j < squares; ++j)
        for (int i = 0; i < squares; ++i) {
            Vec3 from = low, to = high;
            from[e] = low[e] + i * step_e, to[e] = from[e] + step_e;
            from[f] = low[f] + j * step_f, to[f] = from[f] + step_f;
            double const full = step_e * step_f, own = share ? share(from, to) : full;
            if (own <= 0) continue;
            out.nominal += own;
            out.free += own / full * geometry::open_area(*data.chamber.region, static_cast<int>(d), from, to, beside);
        }
    return out;
}
}
