// Cells and granules of a place are on one rank, and every rank has as much to do. Work is counted, never timed, so a
// run that is continued is cut as the run that was not.
#include "granum/grid/recut.hpp"
#include "granum/sim/simulation.hpp"

#include <algorithm>

namespace granum::sim
{
namespace
{
// In steps of a granule without contacts (19 ns with 400,000 granules): what a gas step costs for a cell (1.0 us) and
// for a granule (0.6 us). Measured by `./dev bench sizes`.
constexpr double work_of_cell = 50, work_of_exchange = 30;
constexpr int gas_steps_between_looks = 100;
constexpr double bearable = 1.1;      // largest work of a rank over the mean
constexpr double worth_while = 0.95;  // largest work after cutting anew over that before

std::vector<double> work_by_rank(par::Partition const& partition, std::vector<math::Vec3> const& points,
                                 std::vector<double> const& work, par::Communicator const& comm)
{
    std::vector<double> out(static_cast<std::size_t>(comm.size()), 0.0);
    for (std::size_t k = 0; k < points.size(); ++k)
        out[static_cast<std::size_t>(partition.owner(points[k]))] += work[k];
    comm.sum(out);
    return out;
}
}

void Simulation::add_cells(std::vector<math::Vec3>& points, std::vector<double>& work) const
{
    auto const& [xs, ys, zs] = lines_;
    auto const middle = [](std::vector<double> const& faces, std::size_t i) { return 0.5 * (faces[i] + faces[i + 1]); };
    std::size_t const ranks = static_cast<std::size_t>(comm_.size()), rank = static_cast<std::size_t>(comm_.rank());
    for (std::size_t k = rank; k + 1 < zs.size(); k += ranks)
        for (std::size_t j = 0; j + 1 < ys.size(); ++j)
            for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
                math::Vec3 const centre{middle(xs, i), middle(ys, j), middle(zs, k)};
                if (!case_.chamber.inside(centre)) continue;
                points.push_back(centre);
                work.push_back(work_of_cell);
            }
}

par::Partition Simulation::partition(std::vector<math::Vec3> points, std::vector<double> work) const
{
    par::Space const space{{case_.chamber.lower(), case_.chamber.upper()}, case_.periodic};
    if (!case_.gas.present) {
        work.resize(points.size(), 1.0);
        return par::Partition::balanced(space, points, work, comm_);
    }
    // As long as nobody knows better: a gas step of fifty granule steps with two contacts.
    work.resize(points.size(), 50 * 2 + work_of_exchange);
    add_cells(points, work);
    return par::Partition::balanced(space, points, work, comm_, &lines_);
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
    std::vector<math::Vec3> points = granules_.position.values;
    points.resize(granules_.owned);
    auto work = engine_->work();
    for (double& one : work) one = substeps * one + work_of_exchange;
    add_cells(points, work);
    auto const now = work_by_rank(*partition_, points, work, comm_);
    double sum = 0;
    for (double const one : now) sum += one;
    double const most = *std::max_element(now.begin(), now.end());
    if (!forced && most * comm_.size() < bearable * sum) return;
    par::Space const& space = partition_->space();
    auto fresh = par::Partition::balanced(space, points, work, comm_, &lines_);
    auto const then = work_by_rank(fresh, points, work, comm_);
    if (!forced && *std::max_element(then.begin(), then.end()) > worth_while * most) return;
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
