#include "granum/geometry/triangulate.hpp"

#include "granum/base/error.hpp"
#include "granum/geometry/lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace granum::geometry
{
namespace
{
//! Edge of a cube along `axis`, beside the corner by u and v in the two directions that follow.
constexpr std::size_t edge_of(std::size_t axis, int u, int v)
{
    return 4 * axis + static_cast<std::size_t>(2 * v + u);
}

Spot start_of(Spot const& cube, std::size_t edge)
{
    std::size_t const axis = edge / 4;
    Spot out = cube;
    out[(axis + 1) % 3] += static_cast<int>(edge & 1);
    out[(axis + 2) % 3] += static_cast<int>(edge >> 1 & 1);
    return out;
}

class Contour
{
  public:
    Contour(Region const& region, double resolution) : region_(region), lattice_(region, resolution) {}

    Mesh draw()
    {
        for (auto const& cube : lattice_.near_cubes()) {
            refuse_thin_walls(cube);
            place_points(cube);
        }
        for (auto const& cube : lattice_.near_cubes())
            for (std::size_t axis = 0; axis < 3; ++axis) join_around(cube, axis);
        return std::move(mesh_);
    }

  private:
    using Ends = std::array<bool, 2>;

    Ends ends(Spot const& from, std::size_t axis)
    {
        Spot to = from;
        ++to[axis];
        return {lattice_.open(from), lattice_.open(to)};
    }
    bool crossed(Spot const& cube, std::size_t edge)
    {
        auto const [from, to] = ends(start_of(cube, edge), edge / 4);
        return from != to;
    }

    //! Each edge is looked at from the cube that it begins in.
    void refuse_thin_walls(Spot const& cube)
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Spot end = cube;
            ++end[axis];
            double const from = lattice_.distance(cube), to = lattice_.distance(end);
            if (!(from > 0 && to > 0) || from + to >= lattice_.edge()) continue;
            Vec3 const a = lattice_.place(cube), b = lattice_.place(end);
            // A wall that bulges into the edge is met from one side, a thin one from both.
            if (dot(region_.normal(a), region_.normal(b)) > -0.7 || !region_.blocked(a, b)) continue;
            Vec3 const at = 0.5 * (a + b);
            throw base::CaseError({{"",
                                    0,
                                    region_.name(region_.nearest_solid(at)),
                                    fmt::format("is thinner than the {:g} m between corners of its triangles, about "
                                                "({:.4g}, {:.4g}, {:.4g}) m",
                                                lattice_.edge(), at.x, at.y, at.z),
                                    {"choose a finer resolution"}}});
        }
    }

    //! Edges of the cube that one piece of wall crosses get the same number.
    std::array<std::size_t, 12> pieces(Spot const& cube)
    {
        std::array<std::size_t, 12> root{};
        for (std::size_t e = 0; e < 12; ++e) root[e] = e;
        auto const find = [&](std::size_t e) {
            while (root[e] != e) e = root[e];
            return e;
        };
        auto const join = [&](std::size_t a, std::size_t b) { root[find(a)] = find(b); };
        for (std::size_t d = 0; d < 3; ++d)
            for (int side : {0, 1}) {
                // Edges around the face; edge k leads from corner k to the next.
                std::size_t const u = (d + 1) % 3, v = (d + 2) % 3;
                std::array<std::size_t, 4> const around{edge_of(u, 0, side), edge_of(v, side, 1), edge_of(u, 1, side),
                                                        edge_of(v, side, 0)};
                std::vector<std::size_t> cut;
                for (std::size_t const edge : around)
                    if (crossed(cube, edge)) cut.push_back(edge);
                if (cut.size() == 2) join(cut[0], cut[1]);
                if (cut.size() != 4) continue;
                // Corners are open and closed in turn: the two that are not like the middle are cut off.
                Vec3 within{0.5, 0.5, 0.5};
                within[d] = side;
                bool const middle = region_.distance(lattice_.place(cube, within)) > 0;
                Spot corner = cube;
                corner[d] += side;
                bool const first_is_like = lattice_.open(corner) == middle;
                for (std::size_t k = first_is_like ? 1 : 0; k < 4; k += 2) join(around[(k + 3) % 4], around[k]);
            }
        for (auto& one : root) one = find(one);
        return root;
    }

    void place_points(Spot const& cube)
    {
        std::vector<std::size_t> cut;
        for (std::size_t e = 0; e < 12; ++e)
            if (crossed(cube, e)) cut.push_back(e);
        if (cut.empty()) return;
        auto const piece = pieces(cube);
        auto& points = points_of_[Lattice::key(cube)];
        points.fill(nothing);
        for (std::size_t const first : cut) {
            if (points[first] != nothing) continue;
            std::vector<TangentPlane> planes;
            for (std::size_t const e : cut) {
                if (piece[e] != piece[first]) continue;
                points[e] = points_.size();
                planes.push_back(lattice_.crossing(start_of(cube, e), e / 4));
            }
            points_.push_back(point_for(cube, planes));
        }
    }

    //! A point of the wall in the cube: at its corner or edge, if the crossings have one.
    Vec3 point_for(Spot const& cube, std::vector<TangentPlane> const& crossings) const
    {
        Vec3 middle;
        for (auto const& one : crossings) middle += one.point / static_cast<double>(crossings.size());
        Vec3 const centre = lattice_.place(cube, {0.5, 0.5, 0.5});
        auto const within = [&](Vec3 const& x) {
            double const most = 0.75 * lattice_.edge();
            return std::abs(x.x - centre.x) < most && std::abs(x.y - centre.y) < most &&
                   std::abs(x.z - centre.z) < most;
        };
        for (int most = 3; most > 0; --most) {
            Vec3 x = planes_point(crossings, middle, most);
            // The same with the planes that are met nearer to the point, until it lies on the wall.
            for (int turn = 0; turn < 6 && within(x); ++turn) {
                if (turn > 0 && std::abs(region_.distance(x)) < 1e-4 * lattice_.edge()) break;
                std::vector<TangentPlane> near;
                double const closer = turn < 3 ? 0.3 : 0.05;
                for (auto const& one : crossings) {
                    Vec3 const aside = x + closer * (one.point - x);
                    auto const wall = region_.at(aside);
                    near.push_back({aside - wall.distance * wall.normal, wall.normal});
                }
                x = planes_point(near, x, most);
            }
            if (within(x) && std::abs(region_.distance(x)) < 5e-4 * lattice_.edge()) return x;
        }
        Vec3 x = middle;
        for (int turn = 0; turn < 20; ++turn) {
            auto const wall = region_.at(x);
            if (std::abs(wall.distance) < 1e-4 * lattice_.edge()) break;
            x = x - wall.distance * wall.normal;
        }
        return x;
    }

    //! Two triangles over the points of the four cubes around an edge that is crossed.
    void join_around(Spot const& from, std::size_t axis)
    {
        auto const [open, far_open] = ends(from, axis);
        if (open == far_open) return;
        std::size_t const u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<Vec3, 4> at;  // against the clock, seen from the far end of the edge
        static constexpr std::array<std::array<int, 2>, 4> round{{{1, 1}, {0, 1}, {0, 0}, {1, 0}}};
        for (std::size_t k = 0; k < 4; ++k) {
            Spot cube = from;
            cube[u] -= round[k][0], cube[v] -= round[k][1];
            at[k] = points_[points_of_.at(Lattice::key(cube))[edge_of(axis, round[k][0], round[k][1])]];
        }
        if (open) std::swap(at[1], at[3]);  // normals lead to the open
        auto const off = [&](Vec3 const& a, Vec3 const& b) { return std::abs(region_.distance(0.5 * (a + b))); };
        if (off(at[0], at[2]) <= off(at[1], at[3]))
            mesh_.triangles.insert(mesh_.triangles.end(), {{at[0], at[1], at[2]}, {at[0], at[2], at[3]}});
        else
            mesh_.triangles.insert(mesh_.triangles.end(), {{at[0], at[1], at[3]}, {at[1], at[2], at[3]}});
    }

    static constexpr std::size_t nothing = static_cast<std::size_t>(-1);

    Region const& region_;
    Lattice lattice_;
    std::vector<Vec3> points_;
    std::unordered_map<std::uint64_t, std::array<std::size_t, 12>> points_of_;  // by cube and edge
    Mesh mesh_;
};
}

Mesh triangulate(Region const& region, double resolution)
{
    return Contour(region, resolution).draw();
}
}
