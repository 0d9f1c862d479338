// Reads [[feed]]: where and when the granules of a batch come in while a run goes on.
#include "granum/sim/case_sections.hpp"

#include <algorithm>
#include <cmath>

namespace granum::sim
{
using io::Dimension;

RegionCase read_box(io::CaseFile& file, std::string const& key, geometry::Chamber const& chamber,
                    std::string const& doc)
{
    RegionCase region;
    region.lower = file.vector(key + "lower", Dimension::length, std::nullopt, doc);
    region.upper = file.vector(key + "upper", Dimension::length, std::nullopt, doc);
    if (file.wrong(key + "lower") || file.wrong(key + "upper") || !chamber.known()) return region;
    Vec3 const low = chamber.lower(), high = chamber.upper();
    for (std::size_t d = 0; d < 3; ++d) {
        if (!(region.lower[d] < region.upper[d])) {
            file.mistake(key + "upper", "is not above the lower corner");
            break;
        }
        if (region.lower[d] < low[d] - 1e-12 || region.upper[d] > high[d] + 1e-12) {
            file.mistake(key + (region.lower[d] < low[d] - 1e-12 ? "lower" : "upper"), "is outside the apparatus",
                         {fmt::format("allowed along {}: {:.4g} to {:.4g} m", "xyz"[d], low[d], high[d])});
            break;
        }
    }
    return region;
}

namespace
{
constexpr auto where_they_appear = "corner of the box where they appear";
}

void read_region(io::CaseFile& file, Case& data)
{
    file.section("granules.region");
    if (file.has("granules.region"))
        data.granules.region = read_box(file, "granules.region.", data.chamber, where_they_appear);
    else
        file.know("granules.region.lower"), file.know("granules.region.upper");
}

void read_feeds(io::CaseFile& file, Case& data)
{
    auto& batches = data.granules.batches;
    std::vector<std::string> names;
    for (auto const& batch : batches) names.push_back(batch.name);
    int const count = file.count("feed");
    for (int i = 0; i < count; ++i) {
        auto const key = fmt::format("feed[{}].", i);
        FeedCase feed;
        auto const name = file.name(key + "batch", names.size() == 1 ? std::optional(names[0]) : std::nullopt,
                                    "what comes in", names, "a batch of [granules]");
        auto const found = std::find(names.begin(), names.end(), name);
        feed.region = read_box(file, key, data.chamber, where_they_appear);
        feed.rate =
            file.quantity(key + "rate", Dimension::mass_flow, 0, "0: as fast as there is room", io::not_negative);
        feed.start = file.quantity(key + "start", Dimension::time, 0, "when it begins", io::not_negative);
        feed.stop =
            file.optional_quantity(key + "stop", Dimension::time, "when it ends at the latest", io::not_negative)
                .value_or(feed.stop);
        feed.velocity = file.vector(key + "velocity", Dimension::velocity, Vec3{}, "with which they appear");
        feed.interval =
            file.quantity(key + "interval", Dimension::time, feed.interval, "between portions", io::positive);
        if (feed.stop <= feed.start) file.mistake(key + "stop", "is not after the start");
        if (data.gas.present || file.has("gas")) file.mistake("feed", "goes with granules alone", {"leave out [gas]"});
        if (found == names.end()) continue;
        feed.batch = static_cast<std::size_t>(found - names.begin());
        if (std::any_of(data.feeds.begin(), data.feeds.end(), [&](auto const& f) { return f.batch == feed.batch; }))
            file.mistake(key + "batch", "has a feed already");
        auto const& batch = batches[feed.batch];
        double const widest = batch.sizes.largest() * batch.parcel_ratio;
        Vec3 const size = feed.region.upper - feed.region.lower;
        if (!file.wrong(key + "upper") && !file.wrong(key + "lower") && std::min({size.x, size.y, size.z}) <= widest)
            file.mistake(key + "upper",
                         fmt::format("makes a region narrower than a granule of {:.3g} mm", 1e3 * widest));
        data.feeds.push_back(feed);
    }
}
}
