#include "granum/grid/layout.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace granum::grid
{
namespace
{
int nearest(std::vector<double> const& faces, double x)
{
    auto const above = std::lower_bound(faces.begin(), faces.end(), x);
    if (above == faces.begin()) return 0;
    if (above == faces.end()) return static_cast<int>(faces.size()) - 1;
    int const i = static_cast<int>(above - faces.begin());
    return *above - x < x - *(above - 1) ? i : i - 1;
}
}

Lines uniform_lines(math::Vec3 const& lower, math::Vec3 const& upper, std::array<int, 3> cells)
{
    base::require(std::min({cells[0], cells[1], cells[2]}) > 0,
                  "gas cells must be at least 1 x 1 x 1, got {} x {} x {}", cells[0], cells[1], cells[2]);
    Lines lines;
    for (std::size_t d = 0; d < 3; ++d) {
        double const width = (upper[d] - lower[d]) / cells[d];
        for (int i = 0; i < cells[d]; ++i) lines[d].push_back(lower[d] + i * width);
        lines[d].push_back(upper[d]);  // the last face exactly at the end
    }
    return lines;
}

double widest_at(Lines const& lines, math::Vec3 const& x)
{
    double widest = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        auto const& faces = lines[d];
        auto const above = std::upper_bound(faces.begin() + 1, faces.end() - 1, x[d]);
        widest = std::max(widest, *above - *(above - 1));
    }
    return widest;
}

CellBox Layout::reach(int rank) const
{
    CellBox out = box(rank);
    for (std::size_t d = 0; d < 3; ++d) {
        if (periodic[d] || out.size(d) == 0) continue;
        if (out.lower[d] == 0) --out.lower[d];
        if (out.upper[d] == cells[d]) ++out.upper[d];
    }
    return out;
}

Layout layout(par::Partition const& partition, Lines const& lines)
{
    Layout out;
    out.periodic = partition.space().periodic;
    for (std::size_t d = 0; d < 3; ++d) out.cells[d] = static_cast<int>(lines[d].size()) - 1;
    for (int rank = 0; rank < partition.ranks(); ++rank) {
        auto const& part = partition.box(rank);
        CellBox box;
        for (std::size_t d = 0; d < 3; ++d) {
            auto const& faces = lines[d];
            auto const number = [&](double x) {
                int const i = nearest(faces, x);
                double const off = std::abs(faces[static_cast<std::size_t>(i)] - x);
                base::require(off <= 1e-9 * (faces.back() - faces.front()),
                              "space is cut among ranks at {} m, which is no face of a cell", x);
                return i;
            };
            box.lower[d] = number(part.lower[d]);
            box.upper[d] = number(part.upper[d]);
        }
        base::require(box.cells() > 0, "{} ranks are too many for {} x {} x {} gas cells", partition.ranks(),
                      out.cells[0], out.cells[1], out.cells[2]);
        out.boxes.push_back(box);
    }
    return out;
}
}
