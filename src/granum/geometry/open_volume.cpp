#include "granum/geometry/open_part.hpp"
#include "granum/geometry/wall_model.hpp"

#include <algorithm>
#include <array>

namespace granum::geometry
{
namespace
{
constexpr int deepest = 3;  // halvings before the parts are taken as they are

//! Where the model says open.
SpacePart part_of(WallModel const& model, Vec3 const& half)
{
    SpacePart out = box_part(half, model.first);
    if (model.kind == WallModel::Kind::one) return out;
    SpacePart const both = box_part(half, model.first, model.second);
    if (model.kind == WallModel::Kind::both) return both;
    out += box_part(half, model.second);
    out.volume -= both.volume;
    out.moment -= both.moment;
    return out;
}

struct Halving
{
    Region const& region;

    //! The open part of the box about `middle`, moments about its middle.
    SpacePart open(Vec3 const& middle, Vec3 const& half, Sample const& own, int level) const
    {
        double const reach = norm(half);
        if (own.distance >= reach) return {8 * half.x * half.y * half.z, {}};
        if (own.distance <= -reach) return {};
        std::array<Sample, 9> samples;
        samples[0] = own;
        for (std::size_t k = 0; k < 8; ++k) {
            Vec3 const at{(k & 1) != 0 ? 0.5 * half.x : -0.5 * half.x, (k & 2) != 0 ? 0.5 * half.y : -0.5 * half.y,
                          (k & 4) != 0 ? 0.5 * half.z : -0.5 * half.z};
            samples[k + 1] = sample(region, middle, at);
        }
        if (level > 0)
            if (auto const model =
                    fit(region, middle, half, samples, tolerance_for(2 * std::min({half.x, half.y, half.z}))))
                return part_of(*model, half);
        SpacePart sum;
        for (std::size_t k = 1; k < 9; ++k) {
            Sample part = samples[k];
            Vec3 const at = part.at;
            part.at = {};
            SpacePart found =
                level < deepest ? open(middle + at, 0.5 * half, part, level + 1) : box_part(0.5 * half, part.plane());
            found.moment += found.volume * at;
            sum += found;
        }
        return sum;
    }
};

SpacePart halve(Region const& region, Vec3 const& low, Vec3 const& high)
{
    Vec3 const half = 0.5 * (high - low);
    Halving const halving{region};
    Vec3 const middle = 0.5 * (low + high);
    return halving.open(middle, half, sample(region, middle, {}), 0);
}
}

double open_volume(Region const& region, Vec3 const& low, Vec3 const& high)
{
    Vec3 const middle = 0.5 * (low + high), size = high - low;
    double const reach = 0.5 * norm(size);
    double const away = region.at(middle, reach).distance;
    if (away >= reach) return size.x * size.y * size.z;
    if (away <= -reach) return 0;
    if (auto const* chamber = region.only_chamber(middle, reach)) return chamber->open_volume(low, high);
    return halve(region, low, high).volume;
}

OpenPart open_part(Region const& region, Vec3 const& low, Vec3 const& high)
{
    Vec3 const middle = 0.5 * (low + high);
    SpacePart const found = halve(region, low, high);
    if (found.volume <= 0) return {0, middle};
    Vec3 const centroid = middle + found.moment / found.volume;
    auto const* chamber = region.only_chamber(middle, 0.5 * norm(high - low));
    return {chamber != nullptr ? chamber->open_volume(low, high) : found.volume, centroid};
}
}
