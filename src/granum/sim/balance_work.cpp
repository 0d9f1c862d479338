// Cells and granules of a place are on one rank, and every rank has as much to do. Work is counted, never timed, so a
// run that is continued is cut as the run that was not.
#include "granum/grid/recut.hpp"
#include "granum/sim/simulation.hpp"

#include <algorithm>

namespace granum::sim
{
//! Points with work, and whether it is done in the gas step.
struct WorkPoints
{
    std::vector<math::Vec3> points;
    std::vector<double> work;
    std::vector<bool> of_gas;

    void add(math::Vec3 const& x, double amount, bool gas)
    {
        points.push_back(x), work.push_back(amount), of_gas.push_back(gas);
    }
};

namespace
{
// In steps of a granule without contacts (19 ns with 400,000 granules): what a gas step costs for a cell (1.0 us) and
// for a granule (0.6 us). Measured by `./dev bench sizes`.
constexpr double work_of_cell = 50, work_of_exchange = 30;
constexpr int gas_steps_between_looks = 100;
constexpr double bearable = 1.1;      // time of the slowest over that of the mean
constexpr double worth_while = 0.95;  // time after cutting anew over that before

//! Granule steps and gas step wait for each other: what the slowest ranks of each take, and what the mean rank would.
struct Time
{
    double slowest = 0, mean = 0;
};

Time time_of(par::Partition const& partition, WorkPoints const& all, par::Communicator const& comm)
{
    auto const ranks = static_cast<std::size_t>(comm.size());
    std::vector<double> sums(2 * ranks);
    for (std::size_t k = 0; k < all.points.size(); ++k)
        sums[(all.of_gas[k] ? ranks : 0) + static_cast<std::size_t>(partition.owner(all.points[k]))] += all.work[k];
    comm.sum(sums);
    Time out;
    auto const middle = sums.begin() + static_cast<std::ptrdiff_t>(ranks);
    out.slowest = *std::max_element(sums.begin(), middle) + *std::max_element(middle, sums.end());
    for (double const one : sums) out.mean += one / static_cast<double>(ranks);
    return out;
}
}

void Simulation::add_cells(WorkPoints& all) const
{
    auto const& [xs, ys, zs] = lines_;
    auto const middle = [](std::vector<double> const& faces, std::size_t i) { return 0.5 * (faces[i] + faces[i + 1]); };
    std::size_t const ranks = static_cast<std::size_t>(comm_.size()), rank = static_cast<std::size_t>(comm_.rank());
    for (std::size_t k = rank; k + 1 < zs.size(); k += ranks)
        for (std::size_t j = 0; j + 1 < ys.size(); ++j)
            for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
                math::Vec3 const centre{middle(xs, i), middle(ys, j), middle(zs, k)};
                if (case_.chamber.inside(centre)) all.add(centre, work_of_cell, true);
            }
}

par::Partition Simulation::partition(std::vector<math::Vec3> const& points) const
{
    par::Space const space{{case_.chamber.lower(), case_.chamber.upper()}, case_.periodic};
    if (!case_.gas.present)
        return par::Partition::balanced(space, points, std::vector<double>(points.size(), 1.0), comm_);
    WorkPoints all;
    // As long as nobody knows better: a gas step of fifty granule steps with two contacts.
    for (auto const& x : points) all.add(x, 50 * 2, false), all.add(x, work_of_exchange, true);
    add_cells(all);
    return par::Partition::balanced(space, all.points, all.work, comm_, &lines_, all.of_gas);
}

void Simulation::share_space(par::Partition partition)
{
    partition_ = std::move(partition);
    if (engine_) engine_->repartition(granules_, *partition_);
}

void Simulation::balance_work(int substeps)
{
    auto const every = case_.gas.rebalance_every;
    bool const forced = every > 0 && steps_ > 0 && steps_ % every == 0;
    if (comm_.size() == 1 || (every > 0 ? !forced : steps_ == 0 || steps_ % gas_steps_between_looks != 0)) return;
    WorkPoints all;
    auto const work = engine_->work();
    for (std::size_t row = 0; row < granules_.owned; ++row) {
        all.add(granules_.position[row], substeps * work[row], false);
        all.add(granules_.position[row], work_of_exchange, true);
    }
    add_cells(all);
    auto const now = time_of(*partition_, all, comm_);
    if (!forced && now.slowest < bearable * now.mean) return;
    auto fresh = par::Partition::balanced(partition_->space(), all.points, all.work, comm_, &lines_, all.of_gas);
    if (!forced && time_of(fresh, all, comm_).slowest > worth_while * now.slowest) return;
    share_space(std::move(fresh));
    move_gas();
}

void Simulation::move_gas()
{
    grid::Grid cut = grid::recut(grid_, grid::layout(*partition_, lines_), comm_);
    grid::Field correction = solver_->correction();
    std::vector<grid::Field*> fields{&correction};
    for (auto const& [name, field] : gas_.fields()) fields.push_back(field);
    grid::move(grid_, cut, comm_, fields);
    // All that knows the cells goes before they do.
    around_.reset(), exchange_.reset(), mapping_.reset(), solver_.reset();
    grid_ = std::move(cut);
    make_gas();
    solver_->recall(std::move(correction), std::nullopt);
    if (!case_.spray.present) return;
    find_nozzle_cells();
    std::vector<spray::Droplet> leaving;
    std::erase_if(droplets_, [&](spray::Droplet const& droplet) {
        bool const goes = partition_->owner(droplet.position) != comm_.rank();
        if (goes) leaving.push_back(droplet);
        return goes;
    });
    exchange_droplets(std::move(leaving));
}
}
