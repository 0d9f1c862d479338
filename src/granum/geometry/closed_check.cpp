#include "granum/geometry/closed_check.hpp"

#include "granum/geometry/bounds.hpp"
#include "granum/geometry/mesh_bodies.hpp"
#include "granum/geometry/mesh_crossing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace granum::geometry
{
namespace
{
using Kind = MeshFault::Kind;

std::string place(Vec3 const& x)
{
    return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x.x, x.y, x.z);
}

Vec3 middle(Triangle const& triangle)
{
    return (triangle[0] + triangle[1] + triangle[2]) / 3;
}

std::string plural(std::size_t count, char const* one, char const* many)
{
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

class Inspector
{
  public:
    Inspector(std::span<Triangle const> triangles, ClosedCheck& out) : triangles_(triangles), out_(out)
    {
        Bounds box;
        for (auto const& triangle : triangles)
            for (auto const& corner : triangle) box.widen(corner);
        size_ = box.size();
        out_.corners = join_corners(triangles, lowest_triangle * size_);
    }

    void inspect()
    {
        bool const flat = find_flat(), doubled = find_doubled();
        edges_ = find_edges(out_.corners);
        bool const holes = find_holes(), crowded = !doubled && find_crowded();
        bool const closed = !flat && !doubled && !holes && !crowded;
        if (closed && !find_turned()) find_wrong_bodies();
        if (!doubled) find_crossing();
    }

  private:
    void fault(Kind kind, std::size_t count, std::string what, std::string hint)
    {
        out_.faults.push_back({kind, count, std::move(what), std::move(hint)});
    }
    std::string facet(std::size_t k) const
    {
        return fmt::format("facet {} about {}", k + 1, place(middle(triangles_[k])));
    }

    bool find_flat()
    {
        std::size_t count = 0, first = 0;
        for (std::size_t k = 0; k < triangles_.size(); ++k)
            if (!(triangle_height(triangles_[k]) > lowest_triangle * size_) && count++ == 0) first = k;
        if (count > 0)
            fault(Kind::no_area, count,
                  fmt::format("has {} without area; the first is {}", plural(count, "facet", "facets"), facet(first)),
                  "let the drawing program repair the mesh: merge points, remove degenerate faces");
        return count > 0;
    }

    bool find_doubled()
    {
        std::map<std::array<std::uint32_t, 3>, std::size_t> seen;
        std::size_t count = 0, one = 0, other = 0;
        for (std::size_t k = 0; k < triangles_.size(); ++k) {
            auto corners = out_.corners.of[k];
            std::sort(corners.begin(), corners.end());
            if (corners[0] == corners[1] || corners[1] == corners[2]) continue;
            auto const [before, first] = seen.try_emplace(corners, k);
            if (!first && count++ == 0) one = before->second, other = k;
        }
        if (count > 0)
            fault(Kind::doubled, count,
                  fmt::format("has zero thickness: {} with the same corners, first {} and {}",
                              plural(count, "pair of facets", "pairs of facets"), one + 1, facet(other)),
                  "give the sheet a thickness, or use it as a wall of granules, which need not be a solid");
        return count > 0;
    }

    bool find_holes()
    {
        auto const& points = out_.corners.points;
        std::vector<std::uint32_t> root(points.size());
        std::iota(root.begin(), root.end(), 0u);
        auto const find = [&](std::uint32_t k) {
            while (root[k] != k) k = root[k] = root[root[k]];
            return k;
        };
        std::size_t open = 0;
        for (auto const& edge : edges_.edges)
            if (edge.count == 1) root[find(edge.from)] = find(edge.to), ++open;
        if (open == 0) return false;
        struct Hole
        {
            std::size_t edges = 0;
            double length = 0;
            Vec3 middle;  // times the length
            std::vector<std::size_t> facets{};
        };
        std::map<std::uint32_t, Hole> holes;
        for (auto const& edge : edges_.edges) {
            if (edge.count != 1) continue;
            auto& hole = holes[find(edge.from)];
            Vec3 const &a = points[edge.from], &b = points[edge.to];
            ++hole.edges;
            hole.length += norm(b - a);
            hole.middle += 0.5 * norm(b - a) * (a + b);
            if (hole.facets.size() < 3) hole.facets.push_back(edges_.at(edge)[0].triangle + 1);
        }
        auto const& largest = std::max_element(holes.begin(), holes.end(), [](auto const& a, auto const& b) {
                                  return a.second.length < b.second.length;
                              })->second;
        std::string beside;
        for (std::size_t const k : largest.facets) beside += fmt::format("{}{}", beside.empty() ? "" : ", ", k);
        fault(Kind::hole, holes.size(),
              fmt::format("is not closed: {} with {}; the largest is {:.4g} m round about {}, at facets {}",
                          plural(holes.size(), "hole", "holes"), plural(open, "open edge", "open edges"),
                          largest.length, place(largest.middle / largest.length), beside),
              "close it in the drawing program (\"fill holes\", \"make solid\"), or use it as a wall of granules");
        return true;
    }

    bool find_crowded()
    {
        std::size_t count = 0;
        Edge first{};
        for (auto const& edge : edges_.edges)
            if (edge.count > 2 && count++ == 0) first = edge;
        if (count == 0) return false;
        std::string facets;
        for (auto const& use : edges_.at(first))
            facets += fmt::format("{}{}", facets.empty() ? "" : ", ", use.triangle + 1);
        auto const& points = out_.corners.points;
        fault(Kind::crowded_edge, count,
              fmt::format("has {} with more than two facets; the first has facets {} and goes from {} to {}",
                          plural(count, "edge", "edges"), facets, place(points[first.from]), place(points[first.to])),
              "unite bodies that touch along an edge, and remove walls inside the body");
        return true;
    }

    //! Goes from facet to facet over the edges; those that are fewer face the wrong way.
    bool find_turned()
    {
        std::vector<std::array<std::uint32_t, 3>> beside(triangles_.size());  // edges
        for (std::uint32_t e = 0; e < edges_.edges.size(); ++e)
            for (auto const& use : edges_.at(edges_.edges[e])) beside[use.triangle][use.side] = e;
        std::vector<std::int8_t> way(triangles_.size(), 0);
        std::vector<std::uint32_t> piece;
        std::size_t turned = 0, first = 0, against = 0;
        for (std::uint32_t start = 0; start < triangles_.size(); ++start) {
            if (way[start] != 0) continue;
            piece.assign(1, start);
            way[start] = 1;
            std::size_t other = 0;
            for (std::size_t next = 0; next < piece.size(); ++next) {
                std::uint32_t const k = piece[next];
                other += way[k] < 0;
                for (std::uint32_t const e : beside[k]) {
                    auto const uses = edges_.at(edges_.edges[e]);
                    auto const& there = uses[uses[0].triangle == k ? 1 : 0];
                    bool const same = uses[0].forward != uses[1].forward;
                    auto const wanted = static_cast<std::int8_t>(same ? way[k] : -way[k]);
                    if (way[there.triangle] == 0)
                        way[there.triangle] = wanted, piece.push_back(there.triangle);
                    else
                        against += way[there.triangle] != wanted;
                }
            }
            std::int8_t const wrong = 2 * other > piece.size() ? 1 : -1;
            for (std::uint32_t const k : piece)
                if (way[k] == wrong && turned++ == 0) first = k;
        }
        if (against > 0)
            fault(Kind::one_sided, against / 2, "has one side only: no orientation of its facets fits together",
                  "look for a twist in the drawing");
        else if (turned > 0)
            fault(Kind::turned_facet, turned,
                  fmt::format("has {} turned against {} neighbours; the first is {}", plural(turned, "facet", "facets"),
                              turned == 1 ? "its" : "their", facet(first)),
                  "unify the normals in the drawing program");
        return against > 0 || turned > 0;
    }

    void find_wrong_bodies()
    {
        auto [bodies, of] = find_bodies(out_.corners, edges_);
        bool empty = false;
        for (auto const& body : bodies) {
            if (std::abs(body.volume) > 0.5 * lowest_triangle * size_ * body.area) continue;
            empty = true;
            fault(Kind::no_volume, 1,
                  fmt::format("encloses no volume: the body of {} with {} has zero thickness",
                              plural(body.facets, "facet", "facets"), facet(body.first)),
                  "give it a thickness, or use it as a wall of granules");
        }
        if (empty) return;
        bool const all_wrong =
            std::none_of(bodies.begin(), bodies.end(), [](auto const& body) { return body.faces_right(); });
        if (all_wrong) {
            out_.was_inside_out = true;
            for (auto& corners : out_.corners.of) std::swap(corners[1], corners[2]);
            return;
        }
        for (auto const& body : bodies) {
            if (body.faces_right()) continue;
            if (body.depth % 2 == 1)
                fault(Kind::body_in_body, 1,
                      fmt::format("has a body of {} with {} inside the body of {}; both face outwards",
                                  plural(body.facets, "facet", "facets"), facet(body.first),
                                  facet(bodies[body.around].first)),
                      "unite the two, or turn the inner one round to make it a cavity");
            else
                fault(Kind::turned_body, 1,
                      fmt::format("has a body of {} with {} that is inside out while others are not",
                                  plural(body.facets, "facet", "facets"), facet(body.first)),
                      "unify the normals in the drawing program");
        }
    }

    void find_crossing()
    {
        auto const [crossing, on_another] = find_crossings(out_.corners, size_);
        if (crossing.count > 0)
            fault(Kind::crossing, crossing.count,
                  fmt::format("crosses itself, or two of its bodies overlap: {} go through each other; the first are "
                              "facets {} and {} at {}",
                              plural(crossing.count, "pair of facets", "pairs of facets"), crossing.one + 1,
                              crossing.other + 1, place(crossing.at)),
                  "unite the bodies in the drawing program (\"boolean union\")");
        if (on_another.count > 0)
            fault(Kind::lying_on_another, on_another.count,
                  fmt::format("has zero thickness, or two of its bodies touch: {} lie on each other; the first are "
                              "facets {} and {} at {}",
                              plural(on_another.count, "pair of facets", "pairs of facets"), on_another.one + 1,
                              on_another.other + 1, place(on_another.at)),
                  "give it a thickness, or unite the bodies in the drawing program (\"boolean union\")");
    }

    std::span<Triangle const> triangles_;
    ClosedCheck& out_;
    double size_ = 0;
    Edges edges_;
};
}

double triangle_height(Triangle const& triangle)
{
    Vec3 const a = triangle[1] - triangle[0], b = triangle[2] - triangle[0];
    double const longest = std::sqrt(std::max({norm2(a), norm2(b), norm2(b - a)}));
    return longest > 0 ? norm(cross(a, b)) / longest : 0;
}

ClosedCheck inspect_closed(std::span<Triangle const> triangles)
{
    ClosedCheck out;
    Inspector(triangles, out).inspect();
    return out;
}
}
