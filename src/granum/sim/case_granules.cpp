// Reads [granules], [[granules.batch]] and [[granule]]: which granules there are and how they lie at the start.
#include "granum/base/error.hpp"
#include "granum/io/granules_file.hpp"
#include "granum/io/snapshot_file.hpp"
#include "granum/sim/case_sections.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace granum::sim
{
using io::Dimension;

namespace
{
constexpr double largest_ratio = 10;  //!< of the sizes in all batches, that the neighbour search is made for

//! What another file says is wrong, told at the key that names the file.
void pass_on(io::CaseFile& file, std::string const& key, base::CaseError const& error)
{
    for (auto const& one : error.mistakes) {
        base::Mistake plain = one;
        plain.hints.clear();
        file.mistake(key, plain.text(), one.hints);
    }
}

void read_granule_file(io::CaseFile& file, Case& data)
{
    auto const name =
        file.words("granules.file", "", "CSV file of granules: id,x,y,z,radius[,vx,vy,vz[,wx,wy,wz[,material]]], SI");
    if (name.empty()) return;
    auto const path = file.beside(name);
    if (!std::filesystem::exists(path)) {
        file.mistake("granules.file", fmt::format("cannot be opened ({})", path), {"the path is relative to the case"});
        return;
    }
    try {
        for (auto const& one : io::read_granules(path)) {
            auto material = one.material.empty() ? 0 : material_number(data.contact, one.material);
            if (material == data.contact.materials.size()) {
                file.mistake("granules.file",
                             fmt::format("{}:{}: \"{}\" is not a material of the case", path, one.line, one.material));
                return;
            }
            data.granules.given.push_back({.position = one.position,
                                           .velocity = one.velocity,
                                           .spin = one.spin,
                                           .diameter = 2 * one.radius,
                                           .id = one.id,
                                           .material = material});
        }
    } catch (base::CaseError const& error) {
        pass_on(file, "granules.file", error);
    }
}

//! Granules as the last picture of another run has them; a layer becomes a part of the granule.
void read_run(io::CaseFile& file, Case& data)
{
    auto const name = file.words("granules.run", "", "run folder whose last state is the start");
    if (name.empty()) return;
    auto const path = (std::filesystem::path(file.beside(name)) / "snapshots.h5").string();
    io::GranuleView view;
    try {
        if (!std::filesystem::exists(path)) throw base::IoError(fmt::format("there is no {}", path));
        view = io::read_snapshot(path).granules;
    } catch (base::Error const& error) {
        file.mistake("granules.run", error.what(), {"the path of a run folder, relative to the case"});
        return;
    }
    if (view.mass.size() != view.position.size() || view.position.empty()) {
        file.mistake("granules.run", "holds no granules that a run can start from", {"it is from an older version"});
        return;
    }
    for (std::size_t k = 0; k < view.position.size(); ++k) {
        auto const material = static_cast<std::uint32_t>(view.material[k]);
        if (material >= data.contact.materials.size()) {
            file.mistake("granules.run",
                         fmt::format("has granules of material number {}, which this case lacks", material),
                         {"state the same [material.NAME] tables as that run"});
            return;
        }
        double const volume = view.count[k] * math::pi / 6 * std::pow(view.diameter[k], 3);
        data.granules.given.push_back({.position = view.position[k],
                                       .velocity = view.velocity[k],
                                       .spin = view.spin[k],
                                       .diameter = view.diameter[k],
                                       .density = view.mass[k] / volume,
                                       .count = view.count[k],
                                       .id = static_cast<std::uint64_t>(view.id[k]),
                                       .material = material});
    }
}

void read_tables(io::CaseFile& file, Case& data)
{
    auto& granules = data.granules;
    std::uint64_t next = 0;
    for (auto const& one : granules.given) next = std::max(next, one.id + 1);
    int const count = file.count("granule");
    for (int i = 0; i < count; ++i) {
        auto const key = fmt::format("granule[{}].", i);
        GranuleCase one{.id = next++};
        one.position = file.vector(key + "position", Dimension::length, std::nullopt, "centre");
        one.velocity = file.vector(key + "velocity", Dimension::velocity, math::Vec3{}, "at the start");
        one.spin = file.vector(key + "spin", Dimension::angular_speed, math::Vec3{}, "at the start");
        one.diameter =
            file.optional_quantity(key + "diameter", Dimension::length, "instead of that of [granules]", io::positive)
                .value_or(granules.diameter);
        one.density =
            file.optional_quantity(key + "density", Dimension::density, "instead of that of [granules]", io::positive)
                .value_or(0);
        one.material = read_material(file, data.contact, key + "material", 0, "it is made of");
        one.temperature = file.optional_quantity(key + "temperature", Dimension::temperature,
                                                 "at the start, instead of that of the bed", {.low = 200, .high = 3000})
                              .value_or(0);
        if (one.temperature > 0 && !file.has("gas"))
            file.mistake(key + "temperature", "goes with gas: granules alone have no temperature");
        granules.given.push_back(one);
    }
}

//! Mass or number, parcels, and what follows from them, at the keys that begin with `prefix`.
void read_amount(io::CaseFile& file, std::string const& prefix, BatchCase& batch, bool needed)
{
    auto const mass = file.optional_quantity(prefix + "mass", Dimension::mass, "of the batch", io::positive);
    auto const ratio = file.optional_quantity(prefix + "parcel_ratio", Dimension::one,
                                              "a parcel stands for ratio^3 granules", io::Range{.low = 1});
    bool const counted = file.has(prefix + "parcels"), numbered = file.has(prefix + "number");
    long const parcels =
        file.integer(prefix + "parcels", 0, "number of parcels (instead of parcel_ratio)", 1, 100'000'000);
    long const granules =
        file.integer(prefix + "number", 0, "number of granules (instead of mass)", 1, 1'000'000'000'000);
    if (ratio && counted) file.mistake(prefix + "parcels", "and " + prefix + "parcel_ratio cannot both be given");
    if (mass && numbered) file.mistake(prefix + "number", "and " + prefix + "mass cannot both be given");
    double const one = batch.density * math::pi / 6 * batch.sizes.mean_cube();
    if (!mass && !numbered) {
        if (needed && !file.wrong(prefix + "mass"))
            file.mistake(prefix + "mass", "is missing", {"the batch, e.g. \"1 kg\", or a number of granules"});
        return;
    }
    double const represented = mass ? *mass / one : static_cast<double>(granules);
    if (!std::isfinite(represented)) return;
    batch.mass = mass.value_or(represented * one);
    batch.parcel_ratio =
        counted ? std::max(1.0, std::cbrt(represented / static_cast<double>(parcels))) : ratio.value_or(1);
    double const rows = represented / std::pow(batch.parcel_ratio, 3);
    if (rows > 1e9) {
        file.mistake(prefix + (mass ? "mass" : "number"), fmt::format("makes {:.3g} parcels", rows),
                     {"allowed: up to 1e9; a larger parcel_ratio makes fewer"});
        return;
    }
    batch.parcels = counted && batch.parcel_ratio > 1 ? parcels : std::max(1L, std::lround(rows));
    if (counted)
        file.derived(prefix + "parcel_ratio", fmt::format("{:.4g}", batch.parcel_ratio),
                     "a parcel stands for ratio^3 granules");
    else
        file.derived(prefix + "parcels", fmt::format("{}", batch.parcels), "number of parcels");
}

void read_batches(io::CaseFile& file, Case& data)
{
    auto& granules = data.granules;
    std::set<std::string> names;
    int const count = file.count("granules.batch");
    for (int i = 0; i < count; ++i) {
        auto const prefix = fmt::format("granules.batch[{}].", i);
        BatchCase batch;
        batch.name = file.words(prefix + "name", fmt::format("batch-{}", i + 1), "of the batch");
        if (!names.insert(batch.name).second) file.mistake(prefix + "name", "is the name of another batch too");
        batch.material = read_material(file, data.contact, prefix + "material", 0, "it is made of");
        double const of_material = data.contact.materials[batch.material].density;
        auto const density =
            file.optional_quantity(prefix + "density", Dimension::density, "of a granule", io::positive);
        batch.density = density.value_or(of_material > 0 ? of_material : granules.density);
        if (!(batch.density > 0) && !file.wrong(prefix + "density") && !file.wrong(prefix + "material"))
            file.mistake(prefix + "density", "is missing", {"here, at its material, or in [granules]"});
        auto const diameter =
            file.optional_quantity(prefix + "diameter", Dimension::length, "of a granule", io::positive);
        auto const sizes = read_sizes(file, prefix);
        if (diameter && file.has(prefix + "size")) file.mistake(prefix + "diameter", "and size cannot both be given");
        if (diameter)
            batch.sizes = particle::SizeDistribution::single(*diameter);
        else if (sizes)
            batch.sizes = *sizes;
        else if (!file.has(prefix + "size") && !file.wrong(prefix + "diameter"))
            file.mistake(prefix + "diameter", "is missing", {"one diameter, or size = { distribution = ... }"});
        read_amount(file, prefix, batch, true);
        granules.batches.push_back(batch);
    }
}

//! The whole over all batches: what a gas case needs of its granules, and how far the sizes are apart.
void sum_up(io::CaseFile& file, GranulesCase& granules, std::string const& key)
{
    double volume = 0, area = 0, rows = 0, represented = 0, smallest = 1e300, largest = 0;
    for (auto const& batch : granules.batches) {
        granules.mass += batch.mass;
        granules.parcels += batch.parcels;
        volume += batch.mass / batch.density;
        area += batch.mass / batch.density / batch.sizes.sauter();
        rows += static_cast<double>(batch.parcels);
        represented += static_cast<double>(batch.parcels) * std::pow(batch.parcel_ratio, 3);
        smallest = std::min(smallest, batch.sizes.smallest() * batch.parcel_ratio);
        largest = std::max(largest, batch.sizes.largest() * batch.parcel_ratio);
    }
    if (!(volume > 0)) return;
    granules.diameter = volume / area;
    granules.density = granules.mass / volume;
    granules.parcel_ratio = std::cbrt(represented / rows);
    if (largest > largest_ratio * smallest * (1 + 1e-9))
        file.mistake(key,
                     fmt::format("has granules of {:.3g} to {:.3g} mm, {:.3g} apart", 1e3 * smallest, 1e3 * largest,
                                 largest / smallest),
                     {fmt::format("allowed: up to {:g}; cut the distribution with min and max", largest_ratio)});
}
}

std::uint32_t read_material(io::CaseFile& file, ContactCase const& contact, std::string const& key,
                            std::uint32_t fallback, std::string const& doc)
{
    auto const names = material_names(contact);
    auto const name = file.name(key, names[fallback], doc, names, "a material of the case");
    return file.wrong(key) ? fallback : material_number(contact, name);
}

void read_granules(io::CaseFile& file, Case& data, Purpose purpose)
{
    GranulesCase& granules = data.granules;
    if (!file.has("granules") && !file.has("granule")) return;
    BatchCase whole;
    if (auto const found = material_names(data.contact); file.has("granules.material"))
        for (std::uint32_t m = 2; m < found.size(); ++m)
            if (file.says("granules.material", found[m])) whole.material = m;
    auto& material = data.contact.materials[whole.material];
    bool const batches = file.has("granules.batch"), run = file.has("granules.run"), sized = file.has("granules.size");
    bool const needed = purpose == Purpose::run && !batches && !run;
    auto const or_default = [](bool required, double value) { return required ? std::nullopt : std::optional(value); };
    if (!batches && !sized)
        granules.diameter = file.quantity("granules.diameter", Dimension::length, or_default(needed, granules.diameter),
                                          "of a granule", io::positive);
    else if (file.has("granules.diameter"))
        file.mistake("granules.diameter", "cannot be given beside batches or a size distribution");
    if (batches && !file.has("granules.density"))
        granules.density = 0;
    else
        granules.density = file.quantity(
            "granules.density", Dimension::density,
            or_default(needed && !(material.density > 0), material.density > 0 ? material.density : granules.density),
            "of a granule", io::positive);
    if (!(material.density > 0)) material.density = granules.density;
    granules.heat_capacity = file.quantity("granules.heat_capacity", Dimension::heat_capacity, granules.heat_capacity,
                                           "of the dry granule", io::positive);
    granules.emissivity = file.quantity("granules.emissivity", Dimension::one, granules.emissivity,
                                        "of granules that radiate; 0: none does", io::zero_to_one);
    granules.pores = file.quantity("granules.pores", Dimension::one, granules.pores,
                                   "share of a core's volume that liquid can enter; 0: none", io::zero_to_one);
    granules.pore_radius =
        file.quantity("granules.pore_radius", Dimension::length, granules.pores > 0 ? std::nullopt : std::optional(0.0),
                      "of these pores, effective", {.low = 0, .high = 1e-3});
    if (granules.pores == 0 && file.has("granules.pore_radius"))
        file.mistake("granules.pore_radius", "has no meaning without granules.pores");
    granules.frozen = file.boolean("granules.frozen", false, "granules stay where they are (fixed bed)");
    auto const sizes = read_sizes(file, "granules.");
    read_granule_file(file, data);
    read_run(file, data);
    read_tables(file, data);
    bool const given = !granules.given.empty() || file.has("granules.file") || file.has("granule") || run;

    granules.start =
        file.name("granules.start",
                  given                 ? "given"
                  : data.contact.hard() ? "loose"
                                        : "settled",
                  "how the granules lie at the start", {"settled", "loose", "lattice", "poured", "given"}, "a start");
    if (granules.start == "lattice") {
        granules.spacing = file.quantity("granules.spacing", Dimension::one, granules.spacing,
                                         "of the lattice, in diameters", {.low = 1});
        granules.noise = file.quantity("granules.noise", Dimension::one, 0, "share of the free way that places move",
                                       io::zero_to_one);
    }
    file.know("granules.spacing"), file.know("granules.noise");
    granules.agitation =
        file.quantity("granules.agitation", Dimension::velocity, 0,
                      "root mean square of each component of random velocities at the start", io::not_negative);
    if (granules.agitation > 0 && granules.start != "loose" && granules.start != "lattice")
        file.mistake("granules.agitation", "goes with start = \"loose\" or \"lattice\"",
                     {"other starts have their own velocities, or none"});
    if (data.granules.region && granules.start == "lattice")
        file.mistake("granules.region", "does not go with start = \"lattice\"");
    for (auto const* key : {"granules.spacing", "granules.noise"})
        if (file.has(key) && granules.start != "lattice") file.mistake(key, "belongs to start = \"lattice\"");
    if (given) {
        for (auto const* key : {"mass", "number", "parcels", "batch", "size"})
            if (file.has(std::string("granules.") + key))
                file.mistake(std::string("granules.") + key, "cannot be given where granules are given one by one");
        auto const ratio = file.optional_quantity("granules.parcel_ratio", Dimension::one,
                                                  "a parcel stands for ratio^3 granules", io::Range{.low = 1});
        for (auto const* key : {"mass", "number", "parcels"}) file.know(std::string("granules.") + key);
        granules.parcel_ratio = ratio.value_or(1);
        granules.parcels = static_cast<long>(granules.given.size());
        for (auto& one : granules.given) {
            one.material = one.material == 0 ? whole.material : one.material;
            granules.first_free = std::max(granules.first_free, one.id + 1);
            if (!(one.density > 0) && !(data.contact.materials[one.material].density > 0)) {
                auto const& name = data.contact.materials[one.material].name;
                file.mistake("material." + name, fmt::format("needs a density: granule {} is made of it", one.id));
                break;
            }
        }
        return;
    }
    if (granules.start == "given" && !file.wrong("granules.start"))
        file.mistake("granules.start", "needs granules.file, granules.run or [[granule]] tables");
    if (batches) {
        read_batches(file, data);
        for (auto const* key : {"mass", "number", "parcels", "parcel_ratio", "size"})
            if (file.has(std::string("granules.") + key))
                file.mistake(std::string("granules.") + key, "belongs into each [[granules.batch]]");
    } else {
        whole.name = "granules";
        whole.density = granules.density;
        whole.sizes = sizes.value_or(particle::SizeDistribution::single(granules.diameter));
        read_amount(file, "granules.", whole, needed);
        granules.batches = {whole};
    }
    double const ratio = granules.batches.front().parcel_ratio;
    sum_up(file, granules, batches ? "granules.batch" : "granules.size");
    if (granules.batches.size() == 1) granules.parcel_ratio = ratio;
    granules.first_free = static_cast<std::uint64_t>(granules.parcels);
}
}
