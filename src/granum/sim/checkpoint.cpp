// What a checkpoint holds of the simulation, in one place: everything that the next step depends on.
//
// Not held is what every step computes anew before it reads it: sources, what granules see, stencils, coverage. Numbers
// of which every rank has a share are given back share by share on as many ranks; on another number of ranks the first
// takes their sum. Fields go back box by box.
#include "granum/base/error.hpp"
#include "granum/grid/halo.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/simulation.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

namespace granum::sim
{
namespace
{
//! Fields of the gas on some rank, and which cells it has.
struct GasPart
{
    std::array<int, 3> shift{}, n{};
    std::map<std::string, std::vector<double>> fields;
};

//! Calls visit for all numbers of the gas that are no fields.
template <class Visit>
void each_number(gas::State& gas, Visit&& visit)
{
    visit(gas.last_step), visit(gas.static_pressure);
    for (auto* range : {&gas.temperatures, &gas.vapour_fractions, &gas.tracer_fractions})
        visit(range->least), visit(range->most);
}

//! The saved contacts of `sections` that name a granule of this rank.
std::vector<dem::ContactRecord> contacts_of(particle::Store const& granules, std::vector<io::Section> const& sections)
{
    auto here = granules.id.values;
    std::sort(here.begin(), here.end());
    auto const owned = [&](particle::Id id) { return std::binary_search(here.begin(), here.end(), id); };
    std::vector<dem::ContactRecord> out;
    for (auto const& section : sections)
        for (auto const& record : io::values_of<dem::ContactRecord>(section))
            if (owned(record.low) || owned(record.high)) out.push_back(record);
    return out;
}
}

//! What all ranks had written, as much of it as this rank takes.
struct Simulation::Saved
{
    bool same_ranks = false;
    particle::Store granules;
    std::vector<io::Section> contacts;
    io::Sections hard;              //!< of hard spheres
    std::vector<double> wall_time;  //!< one number, s
    std::vector<geometry::ServoState> servos;
    std::vector<std::uint64_t> deposit_owners;
    std::vector<drying::Deposit> deposits;
    std::vector<spray::Droplet> droplets;
    std::vector<drying::Event> events;
    double history_step = 0;
    std::vector<particle::Id> history_owners;
    std::vector<double> histories;
    std::vector<double> common, shares;
    std::array<base::ExactSum, 3> energies;  //!< dissipated, elastic, work of walls
    std::vector<GasPart> gas;                //!< by the rank that wrote
    std::vector<double> gas_numbers, cuts;
    std::vector<double> preconditioner;
};

template <class Visit>
void Simulation::each_common_number(Visit&& visit)
{
    visit(case_.granules.parcels);
    visit(time_), visit(steps_), visit(granule_steps_), visit(unconverged_);
    for (Ledger* ledger : {&ledgers_.solids, &ledgers_.water, &ledgers_.energy})
        visit(ledger->start), visit(ledger->reference);
    visit(ledgers_.momentum);
    visit(last_.pressure_iterations), visit(last_.pressure_converged);
    visit(traffic_.fed), visit(traffic_.left), visit(traffic_.fed_mass), visit(traffic_.left_mass);
    visit(traffic_.fed_energy), visit(traffic_.left_energy);
    visit(next_feed_), visit(feed_rounds_);
    visit(settling_.end), visit(settling_.enough), visit(settling_.since), visit(settling_.water);
    for (auto& feed : feeds_) visit(feed.placed), visit(feed.mass);
    if (hard_) visit(granule_dt_);
    auto& watch = mover_->watch();
    visit(watch.largest_overlap), visit(watch.warned_overlaps), visit(watch.late_lists), visit(watch.rebuilds);
}

template <class Visit>
void Simulation::each_share(Visit&& visit)
{
    for (auto* sums : {&in_, &out_})
        for (double& sum : *sums) visit(sum);
    visit(mine_.solids), visit(mine_.water), visit(mine_.deposited), visit(mine_.walls), visit(mine_.overspray);
    visit(mine_.in_flight), visit(mine_.evaporated), visit(mine_.deposited_water), visit(mine_.hits);
    visit(mine_.splashed), visit(mine_.abraded), visit(mine_.rebounds);
    visit(heat_.contacts), visit(heat_.film), visit(heat_.wall_contacts), visit(heat_.wall_film);
    visit(heat_.wall_gas), visit(heat_.radiation), visit(heat_.settling);
    visit(last_.mass_in), visit(last_.mass_out), visit(last_.vapour_in), visit(last_.vapour_out);
    visit(last_.tracer_in), visit(last_.tracer_out);
    visit(last_.enthalpy_in), visit(last_.enthalpy_out), visit(last_.wall_heat), visit(last_.pressure_work);
}

io::Sections Simulation::save()
{
    io::Sections out;
    std::vector<double> common, shares;
    each_common_number([&](auto const& number) { common.push_back(static_cast<double>(number)); });
    each_share([&](auto const& number) { shares.push_back(static_cast<double>(number)); });
    out.push_back(io::section_of("common", common));
    out.push_back(io::section_of("shares", shares));
    auto const& watch = mover_->watch();
    out.push_back(io::section_of("energies", std::vector{watch.dissipated, watch.elastic, watch.wall_work}));

    particle::for_each_column(granules_, [&](auto const& column) {
        auto const bytes = std::as_bytes(std::span(column.values).first(granules_.owned));
        out.push_back({"granules." + std::string(column.traits.name), {bytes.begin(), bytes.end()}});
    });
    if (hard_) {
        for (auto& section : hard_->save()) out.push_back(std::move(section));
    } else {
        out.push_back(io::section_of("contacts", engine_->save_contacts()));
        out.push_back(io::section_of("walls.time", std::vector<double>{engine_->time()}));
        out.push_back(io::section_of("walls.servos", engine_->servos()));
    }
    if (case_.spray.present) {
        std::vector<std::uint64_t> owners;
        std::vector<drying::Deposit> deposits;
        for (std::size_t row = 0; row < granules_.owned; ++row)
            for (auto const& deposit : deposits_->on(granules_.id[row])) {
                owners.push_back(granules_.id[row]);
                deposits.push_back(deposit);
            }
        out.push_back(io::section_of("deposits.granule", owners));
        out.push_back(io::section_of("deposits", deposits));
        out.push_back(io::section_of("droplets", droplets_));
        out.push_back(io::section_of("events", events_));
    }
    if (histories_) {
        std::vector<particle::Id> of;
        std::vector<double> values;
        histories_->save(of, values);
        out.push_back(io::section_of("histories.step", std::vector{histories_->step()}));
        out.push_back(io::section_of("histories.granule", of));
        out.push_back(io::section_of("histories", values));
    }
    if (has_gas()) {
        out.push_back(io::section_of("grid", std::vector<int>{grid_.shift[0], grid_.shift[1], grid_.shift[2],
                                                              grid_.n[0], grid_.n[1], grid_.n[2]}));
        out.push_back(io::section_of("cuts", partition_->cuts()));
        std::vector<double> of_gas;
        each_number(gas_, [&](double number) { of_gas.push_back(number); });
        out.push_back(io::section_of("gas_numbers", of_gas));
        for (auto const& [name, field] : gas_.fields())
            out.push_back(io::section_of("gas." + std::string(name), *field));
        out.push_back(io::section_of("gas.correction", solver_->correction()));
        auto const& memory = solver_->pressure_memory();
        std::vector<double> numbers{double(memory.set_up), double(memory.stale), double(memory.fresh_iterations),
                                    double(memory.solves)};
        if (memory.set_up)
            for (auto const* field : {&memory.diagonal, &memory.link[0], &memory.link[1], &memory.link[2]})
                numbers.insert(numbers.end(), field->begin(), field->end());
        out.push_back(io::section_of("preconditioner", numbers));
    }
    return out;
}

std::shared_ptr<Simulation::Saved const> Simulation::read(io::Checkpoint const& from) const
{
    auto const all = std::make_shared<Saved>();
    Saved& out = *all;
    int const rank = comm_.rank();
    out.same_ranks = from.label.ranks == comm_.size();
    out.granules.keep(column_groups(case_));
    auto const append = [](auto& list, auto const& more) { list.insert(list.end(), more.begin(), more.end()); };
    for (int writer = 0; writer < from.label.ranks; ++writer) {
        auto const sections = from.read(writer);
        auto const find = [&](std::string const& name) -> io::Section const& {
            return io::find_section(sections, name);
        };
        bool const mine = out.same_ranks && writer == rank;

        // On as many ranks each takes its own; otherwise an equal share, from which space is cut.
        auto const position = io::values_of<math::Vec3>(find("granules.position"));
        std::vector<std::size_t> rows;
        auto const takes = [&](std::size_t row) {
            if (out.same_ranks) return mine;
            return row % static_cast<std::size_t>(comm_.size()) == static_cast<std::size_t>(rank);
        };
        for (std::size_t row = 0; row < position.size(); ++row)
            if (takes(row)) rows.push_back(row);
        std::size_t const first = out.granules.rows();
        out.granules.resize(first + rows.size());
        particle::for_each_column(out.granules, [&](auto& column) {
            using Value = std::decay_t<decltype(column.values[0])>;
            auto const values = io::values_of<Value>(find("granules." + std::string(column.traits.name)));
            if (values.size() != position.size())
                throw base::IoError(fmt::format("{}: column {} has {} rows, others {}", from.folder, column.traits.name,
                                                values.size(), position.size()));
            for (std::size_t k = 0; k < rows.size(); ++k) column.values[first + k] = values[rows[k]];
        });
        if (hard_) {
            for (auto const* name : {"hard.last", "hard.numbers", "hard.loads", "hard.earlier"})
                out.hard.push_back(find(name));
        } else {
            out.contacts.push_back(find("contacts"));
            out.wall_time = io::values_of<double>(find("walls.time"));
            out.servos = io::values_of<geometry::ServoState>(find("walls.servos"));
        }
        auto const shares = io::values_of<double>(find("shares"));
        // The same on every rank, but for the largest of something that each has seen.
        auto const common = io::values_of<double>(find("common"));
        out.common.resize(common.size(), -1);
        for (std::size_t k = 0; k < common.size(); ++k) out.common[k] = std::max(out.common[k], common[k]);
        if (mine || (!out.same_ranks && rank == 0)) {
            out.shares.resize(std::max(out.shares.size(), shares.size()));
            for (std::size_t k = 0; k < shares.size(); ++k) out.shares[k] += shares[k];
            auto const energies = io::values_of<base::ExactSum>(find("energies"));
            for (std::size_t k = 0; k < std::min(energies.size(), out.energies.size()); ++k)
                out.energies[k].add(energies[k]);
            if (case_.spray.present) append(out.events, io::values_of<drying::Event>(find("events")));
        }
        if (case_.spray.present) {
            append(out.deposit_owners, io::values_of<std::uint64_t>(find("deposits.granule")));
            append(out.deposits, io::values_of<drying::Deposit>(find("deposits")));
            if (mine || !out.same_ranks) append(out.droplets, io::values_of<spray::Droplet>(find("droplets")));
        }
        if (case_.gas.forces.history > 0) {
            out.history_step = io::values_of<double>(find("histories.step")).at(0);
            append(out.history_owners, io::values_of<particle::Id>(find("histories.granule")));
            append(out.histories, io::values_of<double>(find("histories")));
        }
        if (case_.gas.present) {
            auto const place = io::values_of<int>(find("grid"));
            if (place.size() != 6) throw base::IoError(fmt::format("{}: the grid has no place", from.folder));
            GasPart part{.shift = {place[0], place[1], place[2]}, .n = {place[3], place[4], place[5]}, .fields = {}};
            out.gas_numbers = io::values_of<double>(find("gas_numbers"));
            out.cuts = io::values_of<double>(find("cuts"));
            for (auto const& section : sections)
                if (section.name.starts_with("gas.")) part.fields[section.name] = io::values_of<double>(section);
            out.gas.push_back(std::move(part));
            if (mine) out.preconditioner = io::values_of<double>(find("preconditioner"));
        }
    }
    out.granules.owned = out.granules.rows();
    return all;
}

void Simulation::take_granules(Saved const& saved)
{
    granules_ = saved.granules;
    partition_ = saved.same_ranks && case_.gas.present
                     ? par::Partition({{case_.chamber.lower(), case_.chamber.upper()}, case_.periodic}, saved.cuts)
                     : partition(granules_.position.values);
    case_.granules.given.clear();
    fill_feeds();
    case_.granules.parcels = static_cast<long>(saved.common.at(0));
}

void Simulation::take_contacts(Saved const& saved)
{
    if (case_.spray.present) {
        auto here = granules_.id.values;
        std::sort(here.begin(), here.end());
        for (std::size_t k = 0; k < saved.deposits.size() && k < saved.deposit_owners.size(); ++k) {
            auto const id = saved.deposit_owners[k];
            if (std::binary_search(here.begin(), here.end(), id)) deposits_->on(id).push_back(saved.deposits[k]);
        }
    }
    if (histories_ && !saved.history_owners.empty()) {
        auto here = granules_.id.values;
        std::sort(here.begin(), here.end());
        std::vector<particle::Id> owners;
        std::vector<double> values;
        std::size_t const each = saved.histories.size() / saved.history_owners.size();
        for (std::size_t k = 0; k < saved.history_owners.size(); ++k) {
            if (!std::binary_search(here.begin(), here.end(), saved.history_owners[k])) continue;
            owners.push_back(saved.history_owners[k]);
            auto const first = saved.histories.begin() + static_cast<std::ptrdiff_t>(k * each);
            values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(each));
        }
        histories_->recall(saved.history_step, owners, values);
    }
    if (hard_) {
        hard_->resume(granules_, saved.hard);
        return;
    }
    engine_->set_clock(saved.wall_time.at(0), saved.servos);
    engine_->resume(granules_, contacts_of(granules_, saved.contacts));
}

void Simulation::take_process(Saved const& saved)
{
    auto const take = [](std::vector<double> const& from) {
        return [&from, at = std::size_t{0}](auto& number) mutable {
            if (at >= from.size()) throw base::IoError("a checkpoint that holds fewer numbers than this version needs");
            number = static_cast<std::decay_t<decltype(number)>>(from[at++]);
        };
    };
    each_common_number(take(saved.common));
    if (!saved.shares.empty()) each_share(take(saved.shares));
    auto& watch = mover_->watch();
    watch.dissipated = saved.energies[0], watch.elastic = saved.energies[1], watch.wall_work = saved.energies[2];
    droplets_.clear();
    for (auto const& droplet : saved.droplets)
        if (saved.same_ranks || partition_->owner(droplet.position) == comm_.rank()) droplets_.push_back(droplet);
    events_ = saved.events;
    if (!has_gas()) return;

    each_number(gas_, take(saved.gas_numbers));
    auto const gather = [&](std::string const& name) {
        grid::Field field = grid_.make_field();
        auto const strange = [&] { return base::IoError(fmt::format("a checkpoint whose {} does not fit", name)); };
        if (saved.same_ranks) {
            auto const& mine = saved.gas[static_cast<std::size_t>(comm_.rank())].fields;
            auto const found = mine.find(name);
            if (found == mine.end() || found->second.size() != field.size()) throw strange();
            return found->second;
        }
        // Cells from whoever owned them, with the ghosts beyond those ends of the domain that are not periodic.
        auto const reaches = [&](std::array<int, 3> const& shift, std::array<int, 3> const& n, std::size_t d) {
            bool const ends = !grid_.periodic[d];
            return std::array{shift[d] - (ends && shift[d] == 0 ? 1 : 0),
                              shift[d] + n[d] + (ends && shift[d] + n[d] == grid_.global[d] ? 1 : 0)};
        };
        for (auto const& part : saved.gas) {
            auto const found = part.fields.find(name);
            grid::Shape const there(part.n);
            if (found == part.fields.end() || found->second.size() != there.size()) throw strange();
            std::array<int, 3> low, high;
            for (std::size_t d = 0; d < 3; ++d) {
                auto const mine = reaches(grid_.shift, grid_.n, d), theirs = reaches(part.shift, part.n, d);
                low[d] = std::max(mine[0], theirs[0]) - grid_.shift[d];
                high[d] = std::min(mine[1], theirs[1]) - 1 - grid_.shift[d];
            }
            grid::for_each_cell(grid_, low, high, [&](int i, int j, int k, grid::Index here) {
                field[here] =
                    found->second[there.at(i + grid_.shift[0] - part.shift[0], j + grid_.shift[1] - part.shift[1],
                                           k + grid_.shift[2] - part.shift[2])];
            });
        }
        grid::refresh(grid_, {&field});
        return field;
    };
    for (auto const& [name, field] : gas_.fields()) *field = gather("gas." + std::string(name));
    std::optional<solve::Pressure::Memory> memory;
    if (saved.same_ranks && saved.preconditioner.size() >= 4) {
        auto const& numbers = saved.preconditioner;
        memory.emplace();
        memory->set_up = numbers[0] != 0, memory->stale = numbers[1] != 0;
        memory->fresh_iterations = static_cast<int>(numbers[2]), memory->solves = static_cast<int>(numbers[3]);
        if (memory->set_up) {
            if (numbers.size() != 4 + 4 * grid_.size())
                throw base::IoError("a checkpoint whose pressure solver is of another grid");
            auto at = numbers.begin() + 4;
            for (auto* field : {&memory->diagonal, &memory->link[0], &memory->link[1], &memory->link[2]}) {
                field->assign(at, at + static_cast<std::ptrdiff_t>(grid_.size()));
                at += static_cast<std::ptrdiff_t>(grid_.size());
            }
        }
    }
    solver_->recall(gather("gas.correction"), std::move(memory));
}
}
