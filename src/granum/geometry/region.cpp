#include "granum/geometry/region.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
constexpr std::int32_t nothing = std::numeric_limits<std::int32_t>::max();
}

Region::Region(std::string name, Solid solid)
{
    if (auto wrong = fault(solid)) throw base::CaseError({{"", 0, name, std::move(*wrong), {}}});
    Bounds const box = geometry::bounds(solid);
    leaves_.push_back({std::move(name), std::move(solid), box, true});
    nodes_.push_back({true, {-1}});
    measure();
}

Region::Region(std::string name, Chamber chamber) : Region(std::move(name), geometry::solid(chamber))
{
    chamber_ = std::move(chamber);
}

Region Region::join(Region a, Region b, bool all)
{
    auto const first_leaf = static_cast<std::int32_t>(a.leaves_.size());
    Node root{all, {}};
    auto const take = [&](Region& from, std::vector<Node>& nodes, std::int32_t leaf_shift) {
        auto const node_shift = static_cast<std::int32_t>(nodes.size());
        for (auto& node : from.nodes_)
            for (auto& part : node.parts) part = part < 0 ? part - leaf_shift : part + node_shift;
        Node top = std::move(from.nodes_.back());
        from.nodes_.pop_back();
        nodes.insert(nodes.end(), std::make_move_iterator(from.nodes_.begin()),
                     std::make_move_iterator(from.nodes_.end()));
        if (top.all == all || top.parts.size() == 1) {
            root.parts.insert(root.parts.end(), top.parts.begin(), top.parts.end());
        } else {
            root.parts.push_back(static_cast<std::int32_t>(nodes.size()));
            nodes.push_back(std::move(top));
        }
    };
    std::vector<Node> nodes;
    take(a, nodes, 0);
    take(b, nodes, first_leaf);
    nodes.push_back(std::move(root));
    a.nodes_ = std::move(nodes);
    a.leaves_.insert(a.leaves_.end(), std::make_move_iterator(b.leaves_.begin()),
                     std::make_move_iterator(b.leaves_.end()));
    if (!all) a.chamber_.reset();
    a.measure();
    return a;
}

void Region::turn_inside_out()
{
    for (auto& leaf : leaves_) leaf.open_inside = !leaf.open_inside;
    for (auto& node : nodes_) node.all = !node.all;
    chamber_.reset();
}

Region operator|(Region a, Region b)
{
    return Region::join(std::move(a), std::move(b), false);
}

Region operator&(Region a, Region b)
{
    return Region::join(std::move(a), std::move(b), true);
}

Region operator-(Region a, Region b)
{
    b.turn_inside_out();
    return Region::join(std::move(a), std::move(b), true);
}

Region operator~(Region a)
{
    a.turn_inside_out();
    a.measure();
    return a;
}

bool Region::bounds_everywhere(std::size_t solid) const
{
    auto const& root = nodes_.back();
    auto const leaf = -1 - static_cast<std::int32_t>(solid);
    return (root.all || root.parts.size() == 1) &&
           std::find(root.parts.begin(), root.parts.end(), leaf) != root.parts.end();
}

std::optional<Region> Region::without(std::vector<std::size_t> const& some) const
{
    Region out = *this;
    auto& parts = out.nodes_.back().parts;
    for (std::size_t const solid : some) {
        if (!bounds_everywhere(solid)) continue;
        std::erase(parts, -1 - static_cast<std::int32_t>(solid));
        if (solid == 0) out.chamber_.reset();
    }
    if (parts.empty()) return std::nullopt;
    out.measure();
    return out;
}

WallDistance Region::leaf_at(std::size_t leaf, Vec3 const& x, double enough) const
{
    auto const [distance, normal] = surface_distance(leaves_[leaf].solid, x, enough);
    if (leaves_[leaf].open_inside) return {-distance, -normal, leaf};
    return {distance, normal, leaf};
}

WallDistance Region::node_at(std::size_t number, Vec3 const& x, double enough, std::int32_t without) const
{
    Node const& node = nodes_[number];
    constexpr double far = std::numeric_limits<double>::infinity();
    WallDistance best{node.all ? far : -far, {0, 0, 1}, 0};
    for (std::int32_t const part : node.parts) {
        if (part == without) continue;
        WallDistance found;
        if (part < 0) {
            auto const leaf = static_cast<std::size_t>(-1 - part);
            // What is away from a solid's box is at least as far from the solid.
            if (leaves_[leaf].open_inside != node.all) {
                double const away = leaves_[leaf].box.distance(x);
                if (away > 0 && (node.all ? away >= best.distance : -away <= best.distance)) continue;
            }
            found = leaf_at(leaf, x, enough);
        } else {
            found = node_at(static_cast<std::size_t>(part), x, enough, nothing);
        }
        if (node.all ? found.distance < best.distance : found.distance > best.distance) best = found;
    }
    return best;
}

WallDistance Region::at(Vec3 const& x, double enough) const
{
    return node_at(nodes_.size() - 1, x, enough, nothing);
}

bool Region::open(Vec3 const& x) const
{
    double const seam = 1e-9 * size_;
    auto const wall = at(x, 2 * seam);
    if (wall.distance > 0) return true;
    if (wall.distance < -seam) return false;
    Vec3 const beside = seam * wall.normal;
    return distance(x + 2 * beside) > 0 && distance(x - 2 * beside) > 0;
}

Chamber const* Region::only_chamber(Vec3 const& x, double reach) const
{
    if (!chamber_) return nullptr;
    bool const alone = nodes_.back().parts.size() == 1;
    return alone || node_at(nodes_.size() - 1, x, reach, -1).distance >= reach ? &*chamber_ : nullptr;
}

Bounds Region::bounds_of(std::int32_t part) const
{
    constexpr double far = std::numeric_limits<double>::infinity();
    Bounds const endless{{-far, -far, -far}, {far, far, far}};
    if (part < 0) {
        auto const& leaf = leaves_[static_cast<std::size_t>(-1 - part)];
        return leaf.open_inside ? leaf.box : endless;
    }
    Node const& node = nodes_[static_cast<std::size_t>(part)];
    Bounds out = node.all ? endless : Bounds{};
    for (std::int32_t const inner : node.parts) {
        Bounds const box = bounds_of(inner);
        if (node.all)
            out = overlap(out, box);
        else
            out.widen(box.lower, box.upper);
    }
    return out;
}

void Region::measure()
{
    bounds_ = bounds_of(static_cast<std::int32_t>(nodes_.size()) - 1);
    bool const bounded = finite(bounds_.lower) && finite(bounds_.upper);
    size_ = bounded ? bounds_.size() : 1;
}
}
