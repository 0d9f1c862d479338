#include "granum/sim/opening_area.hpp"

#include "granum/base/error.hpp"
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

void check_openings(Case const& data, grid::Grid const& grid, par::Communicator const& comm)
{
    std::vector<base::Mistake> mistakes;
    auto const check = [&](OpeningCase const& at, char const* kind) {
        std::size_t const d = at.direction;
        auto const share = gas_opening(data, at).share;
        long faces = 0;
        if (grid.at_end(d, at.upper)) {
            std::array<int, 3> low{}, high{grid.n[0] - 1, grid.n[1] - 1, grid.n[2] - 1};
            low[d] = high[d] = at.upper ? grid.n[d] : 0;
            grid::for_each_cell(grid, low, high, [&](int i, int j, int k, grid::Index face) {
                std::array<int, 3> const cell{i, j, k};
                Vec3 from, to;
                for (std::size_t e = 0; e < 3; ++e) {
                    from[e] = grid.axes[e].face(cell[e]);
                    to[e] = e == d ? from[e] : grid.axes[e].face(cell[e] + 1);
                }
                faces += grid.open_area[d][face] > 0 && (!share || share(from, to) > 0);
            });
        }
        if (comm.sum(faces) > 0) return;
        mistakes.push_back(
            {data.file,
             0,
             "",
             fmt::format("the {} \"{}\" leads nowhere: no open cell behind it is connected to the rest of "
                         "the apparatus",
                         kind, at.name),
             {"a body covers it, or the way past the body is narrower than a cell: move the body, or "
              "give smaller gas.cells"}});
    };
    for (auto const& inlet : data.gas.inlets) check(inlet.at, "inlet");
    for (auto const& outlet : data.gas.outlets) check(outlet.at, "outlet");
    if (!mistakes.empty()) throw base::CaseError(std::move(mistakes));
}
}
