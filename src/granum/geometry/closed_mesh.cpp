#include "granum/geometry/closed_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
std::vector<Triangle> all_triangles(Corners const& corners)
{
    std::vector<Triangle> out;
    out.reserve(corners.of.size());
    for (std::size_t k = 0; k < corners.of.size(); ++k) out.push_back(corners.triangle(k));
    return out;
}

double angle_between(Vec3 const& a, Vec3 const& b)
{
    return std::atan2(norm(cross(a, b)), dot(a, b));
}

//! What of a facet is nearest: its edges a-b, b-c, c-a, its corners a, b, c, or its face.
enum Part : int
{
    edge_ab,
    edge_bc,
    edge_ca,
    corner_a,
    corner_b,
    corner_c,
    face
};

struct Foot
{
    Vec3 off;  // from the foot to the point
    Part part;
};

//! The regions of the plane in which corner, edge or face of the triangle a, a + ab, a + ac is nearest to a + ap.
//! Source: Ericson, Real-Time Collision Detection (2005), 5.1.5.
Foot foot_on(Vec3 const& ab, Vec3 const& ac, Vec3 const& ap)
{
    double const d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return {ap, corner_a};
    Vec3 const bp = ap - ab;
    double const d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return {bp, corner_b};
    double const vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {ap - (d1 / (d1 - d3)) * ab, edge_ab};
    Vec3 const cp = ap - ac;
    double const d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return {cp, corner_c};
    double const vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {ap - (d2 / (d2 - d6)) * ac, edge_ca};
    double const va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        return {bp - ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (ac - ab), edge_bc};
    double const per = 1 / (va + vb + vc);
    return {ap - (vb * per) * ab - (vc * per) * ac, face};
}
}

ClosedMesh::ClosedMesh(Corners const& corners) : triangles_(all_triangles(corners)), tree_(triangles_)
{
    auto const edges = find_edges(corners);
    auto const points = static_cast<std::uint32_t>(corners.points.size());
    pseudo_normals_.resize(points + edges.edges.size());
    facets_.reserve(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        auto const& corner = triangles_[t];
        Facet facet{corner[0], corner[1] - corner[0], corner[2] - corner[0], triangle_normal(corner), {}};
        for (std::size_t c = 0; c < 3; ++c) {
            std::uint32_t const point = corners.of[t][c];
            facet.pseudo[3 + c] = point;
            double const angle = angle_between(corner[(c + 1) % 3] - corner[c], corner[(c + 2) % 3] - corner[c]);
            pseudo_normals_[point] += angle * facet.normal;
            bounds_.widen(corner[c]);
        }
        facets_.push_back(facet);
    }
    for (std::uint32_t e = 0; e < edges.edges.size(); ++e)
        for (auto const& use : edges.at(edges.edges[e])) {
            facets_[use.triangle].pseudo[use.side] = points + e;
            pseudo_normals_[points + e] += facets_[use.triangle].normal;
        }
    for (auto& normal : pseudo_normals_)
        if (double const length = norm(normal); length > 0) normal = normal / length;
    make_rough();
}

void ClosedMesh::make_rough()
{
    if (triangles_.size() < 1000) return;  // where the tree is as fast
    Vec3 const size = bounds_.upper - bounds_.lower;
    rough_.step = std::max({size.x, size.y, size.z}) / 32;
    for (std::size_t d = 0; d < 3; ++d) rough_.n[d] = static_cast<std::size_t>(size[d] / rough_.step) + 1;
    rough_.distance.reserve(rough_.n[0] * rough_.n[1] * rough_.n[2]);
    for (std::size_t k = 0; k < rough_.n[2]; ++k)
        for (std::size_t j = 0; j < rough_.n[1]; ++j)
            for (std::size_t i = 0; i < rough_.n[0]; ++i) {
                Vec3 const at{static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5, static_cast<double>(k) + 0.5};
                rough_.distance.push_back(distance(bounds_.lower + rough_.step * at).distance);
            }
}

double ClosedMesh::rough_distance(Vec3 const& x) const
{
    if (rough_.distance.empty()) return 0;
    double const outside = bounds_.distance(x);
    if (outside > 0) return outside;
    std::array<std::size_t, 3> cube{};
    Vec3 middle = bounds_.lower;
    for (std::size_t d = 0; d < 3; ++d) {
        cube[d] = std::min(static_cast<std::size_t>((x[d] - bounds_.lower[d]) / rough_.step), rough_.n[d] - 1);
        middle[d] += rough_.step * (static_cast<double>(cube[d]) + 0.5);
    }
    double const known = rough_.distance[(cube[2] * rough_.n[1] + cube[1]) * rough_.n[0] + cube[0]];
    return std::copysign(std::max(0.0, std::abs(known) - norm(x - middle)), known);
}

SurfaceDistance ClosedMesh::distance(Vec3 const& x) const
{
    double best2 = Bounds::big;
    std::uint32_t facet = 0;
    Foot best{};
    tree_.nearest(x, best2, [&](std::uint32_t k) {
        Facet const& one = facets_[k];
        // The plane of the facet is no farther than the facet.
        Vec3 const apart = x - one.corner;
        double const height = dot(apart, one.normal);
        if (height * height >= best2) return;
        Foot const foot = foot_on(one.first, one.second, apart);
        double const d2 = norm2(foot.off);
        if (d2 < best2) best2 = d2, facet = k, best = foot;
    });
    Facet const& nearest = facets_[facet];
    if (best.part == face) return {dot(x - nearest.corner, nearest.normal), nearest.normal};
    Vec3 const& pseudo = pseudo_normals_[nearest.pseudo[static_cast<std::size_t>(best.part)]];
    double const distance = std::sqrt(best2), sign = dot(best.off, pseudo) < 0 ? -1 : 1;
    if (distance <= 1e-12 * bounds_.size()) return {sign * distance, pseudo};
    return {sign * distance, (sign / distance) * best.off};
}

double ClosedMesh::volume() const
{
    Vec3 const middle = 0.5 * (bounds_.lower + bounds_.upper);
    double sum = 0;
    for (auto const& [a, b, c] : triangles_) sum += dot(a - middle, cross(b - middle, c - middle));
    return sum / 6;
}
}
