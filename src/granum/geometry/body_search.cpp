#include "granum/geometry/body_search.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace granum::geometry
{
namespace
{
constexpr double cos_5_degrees = 0.99619469809174555;
constexpr double seam = 0.01;  // of the radius: edges nearer than this to a face belong to it

std::vector<Triangle> all_triangles(Body const& body)
{
    std::vector<Triangle> out;
    for (auto const& shape : body.shapes)
        if (auto const* mesh = std::get_if<Mesh>(&shape))
            out.insert(out.end(), mesh->triangles.begin(), mesh->triangles.end());
    return out;
}
}

BodySearch::BodySearch(Body const& body) : triangles_(all_triangles(body)), tree_(triangles_)
{
    for (auto const& shape : body.shapes)
        std::visit(
            [&](auto const& one) {
                if constexpr (!std::is_same_v<std::decay_t<decltype(one)>, Mesh>) smooth_.emplace_back(one);
            },
            shape);
    normals_.reserve(triangles_.size());
    for (auto const& triangle : triangles_) normals_.push_back(triangle_normal(triangle));
}

Nearest BodySearch::nearest_of(std::uint32_t facet, Vec3 const& centre) const
{
    if (facet >= smooth_.size()) {
        std::size_t const k = facet - smooth_.size();
        return nearest(triangles_[k], normals_[k], centre);
    }
    return std::visit([&](auto const& shape) { return nearest(shape, centre); }, smooth_[facet]);
}

void BodySearch::near(Vec3 const& centre, double reach, std::vector<std::uint32_t>& facets) const
{
    auto const consider = [&](std::uint32_t facet) {
        if (nearest_of(facet, centre).distance < reach) facets.push_back(facet);
    };
    auto const first_triangle = static_cast<std::uint32_t>(smooth_.size());
    for (std::uint32_t facet = 0; facet < first_triangle; ++facet) consider(facet);
    tree_.near(centre, reach, [&](std::uint32_t triangle) { consider(first_triangle + triangle); });
}

std::size_t BodySearch::touches(Vec3 const& centre, double radius, std::span<std::uint32_t const> facets,
                                Scratch& scratch, std::array<Nearest, most_touches>& out) const
{
    if (facets.size() == 1) {
        out[0] = nearest_of(facets[0], centre);
        return out[0].distance < radius ? 1 : 0;
    }
    auto& candidates = scratch.candidates;
    candidates.clear();
    for (std::uint32_t const facet : facets) {
        Nearest const at = nearest_of(facet, centre);
        if (at.distance < radius) candidates.push_back({at, facet});
    }
    std::sort(candidates.begin(), candidates.end(), [](auto const& a, auto const& b) {
        return a.at.distance < b.at.distance || (a.at.distance == b.at.distance && a.facet < b.facet);
    });
    // A point of an edge is a local minimum only if no nearer facet goes through it.
    auto const covered = [&](std::size_t k) {
        for (std::size_t nearer = 0; nearer < k; ++nearer)
            if (std::abs(nearest_of(candidates[nearer].facet, candidates[k].at.point).distance) <= seam * radius)
                return true;
        return false;
    };
    std::size_t count = 0;
    for (std::size_t k = 0; k < candidates.size() && count < most_touches; ++k) {
        Nearest const& at = candidates[k].at;
        bool dropped = false;
        for (std::size_t a = 0; a < count && !dropped; ++a) dropped = dot(at.normal, out[a].normal) > cos_5_degrees;
        if (dropped || (at.feature != Feature::face && covered(k))) continue;
        out[count++] = at;
    }
    return count;
}
}
