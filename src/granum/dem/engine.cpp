#include "granum/base/error.hpp"
#include "granum/dem/engine_inside.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
using base::Stage;

namespace
{
template <class Any>
void const* address_of(Any const& law)
{
    return std::visit([](auto const& chosen) -> void const* { return &chosen; }, law);
}

void add(base::ExactSum& sum, kernel::Energy const& of_step)
{
    sum.add(of_step.coarse);
    sum.add(of_step.fine);
}

std::size_t history_columns(Laws const& laws)
{
    auto const count = [](auto const& law) {
        return std::visit([](auto const& chosen) { return static_cast<std::size_t>(chosen.history); }, law);
    };
    return count(laws.tangential) + count(laws.rolling);
}
}

Engine::Inside::Inside(Settings given, par::Partition partition, par::Communicator const& communicator)
    : settings(std::move(given)),
      domain{settings.lower, settings.upper, settings.periodic},
      images(domain.images()),
      comm(communicator),
      halo(std::move(partition), communicator),
      kernel(settings.kernel.empty() ? kernel::kernels().front() : kernel::find_kernel(settings.kernel)),
      walls(settings.walls, domain)
{
    base::require(kernel != nullptr, "this processor has no kernel called \"{}\"", settings.kernel);
    auto const& laws = settings.laws;
    for (std::uint32_t a = 0; a < laws.materials.size(); ++a)
        for (std::uint32_t b = 0; b < laws.materials.size(); ++b) {
            pairings.push_back(laws.effective(a, b));
            restitutions.push_back(laws.pair(a, b).restitution);
        }
    rules = {.normal_index = laws.normal.index(),
             .tangential_index = laws.tangential.index(),
             .rolling_index = laws.rolling.index(),
             .normal = address_of(laws.normal),
             .tangential = address_of(laws.tangential),
             .rolling = address_of(laws.rolling),
             .pairs = pairings.data(),
             .materials = laws.materials.size(),
             .lever_shift = laws.lever == Lever::contact_point ? 0.5 : 0.0,
             .inertia = std::holds_alternative<law::contact::EpsdDashpot>(laws.rolling),
             .ledger = settings.energy_ledger,
             .columns = history_columns(laws) + (settings.energy_ledger ? 2 : 0),
             .restitution = restitutions.data(),
             .wear_threshold = settings.wear_threshold};
    pairs.shape(rules.columns);
    walls.shape(rules.columns);
    frame.scale_to(laws);
}

void Engine::Inside::agree_on_failure()
{
    // All say the same, so that whoever is heard first names the granule.
    if (auto const said = comm.first_said(failure); !said.empty()) throw base::NumericsError(said);
}

void Engine::Inside::find_non_finite()
{
    for (std::size_t row = 0; row < frame.owned && failure.empty(); ++row) {
        auto const& body = frame.bodies[row];
        bool good = std::isfinite(body.radius) && body.inverse_mass > 0 && std::isfinite(body.inverse_mass);
        for (std::size_t d = 0; d < 3; ++d)
            good = good && std::isfinite(body.position[d] + body.velocity[d] + body.spin[d]);
        if (!good) failure = fmt::format("granule {} has a state that is not finite at step {}", frame.id[row], steps);
    }
}

void Engine::Inside::name_overlap()
{
    double worst = 0;
    std::string who;
    for (std::size_t b = 0; b < pairs.blocks(); ++b)
        for (std::size_t lane = 0; lane < kernel::block; ++lane) {
            if (!pairs.touching(b, lane)) continue;
            auto const low = pairs.low(b, lane), high = pairs.high(b, lane);
            double const distance = norm(apart(low, high));
            double const overlap =
                (frame.radius(low) + frame.radius(high) - distance) / std::min(frame.radius(low), frame.radius(high));
            if (overlap <= worst) continue;
            worst = overlap;
            who = fmt::format("granules {} and {} overlap by {:.0f} % of a radius", frame.id[low], frame.id[high],
                              100 * overlap);
        }
    for (std::size_t k = 0; k < walls.size(); ++k)
        if (double const overlap = walls.overlap(k) / frame.radius(walls.row(k)); overlap > worst) {
            worst = overlap;
            who = fmt::format("granule {} is {:.0f} % of its radius in wall {}", frame.id[walls.row(k)], 100 * overlap,
                              settings.walls[walls.body(k)].name);
        }
    failure = fmt::format(
        "{} at step {}: the time step is too long, the stiffness too low or granules were placed into each other", who,
        steps);
}

// From the one row to the other, over a periodic face where that is nearer.
Vec3 Engine::Inside::apart(std::uint32_t row, std::uint32_t other) const
{
    Vec3 out = frame.position(row) - frame.position(other);
    for (std::size_t d = 0; d < 3; ++d)
        if (domain.periodic[d]) out[d] -= domain.size()[d] * std::round(out[d] / domain.size()[d]);
    return out;
}

// Of the pairs and walls that can be done when a part of a layer has been moved.
void Engine::Inside::forces(Layers::Part const& part, bool alone, double dt, kernel::Seen& seen)
{
    pairs.run(layers.bins(part, alone), *kernel, rules, frame, images, dt, seen);
    pairs.run(layers.bins_left(part), *kernel, rules, frame, images, dt, seen);
    walls.run(layers.units(part), *kernel, rules, frame, dt, seen);
}

void Engine::Inside::all_forces(double dt)
{
    auto const timing = stopwatch.time(Stage::contacts);
    kernel::Seen seen;
    for (std::size_t layer = 0; layer < layers.count(); ++layer) forces(layers.whole(layer), false, dt, seen);
    finish_forces(dt, seen);
}

// When all layers have their forces of a step.
void Engine::Inside::finish_forces(double dt, kernel::Seen const& seen)
{
    walls.finish(rules, frame, dt, comm);
    watch.largest_overlap = std::max(watch.largest_overlap, seen.largest_overlap);
    if (seen.largest_overlap > settings.warn_overlap) ++watch.warned_overlaps;
    watch.contacts = seen.contacts;
    watch.elastic = {};
    add(watch.dissipated, std::exchange(lost, {}));
    add(watch.dissipated, seen.dissipated);
    add(watch.elastic, seen.elastic);
    add(watch.wall_work, walls.work());
    if (seen.largest_overlap > settings.stop_overlap && failure.empty()) name_overlap();
    stop_alone();
}

// With several ranks a failure is thrown when all know of it.
void Engine::Inside::stop_alone() const
{
    if (comm.size() == 1 && !failure.empty()) throw base::NumericsError(failure);
}

// What part of its room any granule of this rank has used up.
double Engine::Inside::farthest() const
{
    double farthest2 = 0;
    for (std::size_t row = 0; row < frame.owned; ++row) {
        auto const& body = frame.bodies[row];
        farthest2 = std::max(farthest2, body.per_room2 * norm2(frame.position(row) - Frame::vec(body.built)));
    }
    return std::sqrt(farthest2);
}

// Whether the list no longer holds all that may touch, when no granule used up more than `moved` of its room in this
// step. The sum of such bounds grows faster than the true distance, which is looked up when the bound is used up.
// Collective.
bool Engine::Inside::outgrown(double moved)
{
    struct
    {
        double moved, failed;
    } mine{moved, failure.empty() ? 0.0 : 1.0};
    if (comm.size() > 1) MPI_Allreduce(MPI_IN_PLACE, &mine, 2, MPI_DOUBLE, MPI_MAX, comm.handle());
    if (mine.failed > 0) agree_on_failure();
    last_moved = mine.moved;
    travelled += mine.moved;
    if (travelled <= free()) return false;
    travelled = comm.max(farthest());
    // What is left must do for some steps, or the true distance would be looked up in each of them.
    return travelled + 4 * mine.moved > free();
}

Engine::Engine(Settings settings, par::Partition partition, par::Communicator const& comm)
    : inside_(std::make_unique<Inside>(std::move(settings), std::move(partition), comm))
{
}

Engine::Engine(Settings settings, par::Slabs const& slabs, par::Communicator const& comm)
{
    par::Partition partition({{settings.lower, settings.upper}, settings.periodic}, slabs);
    inside_ = std::make_unique<Inside>(std::move(settings), std::move(partition), comm);
}

Engine::~Engine() = default;

void Engine::attach(particle::Attachment& attachment)
{
    inside_->attachments.push_back(&attachment);
}

void Engine::prepare(particle::Store& granules)
{
    auto& in = *inside_;
    std::vector<ContactRecord> known;
    in.pairs.for_each_touching([&](std::uint32_t low, std::uint32_t high, History const& history) {
        known.push_back({in.frame.id[low], in.frame.id[high], history});
    });
    in.walls.for_each_touching([&](std::uint32_t row, Id partner, History const& history) {
        known.push_back({in.frame.id[row], ContactRecord::wall_bit | partner, history});
    });
    resume(granules, known);
    for (auto& body : in.frame.bodies) std::fill_n(body.force, 8, 0.0);
    in.all_forces(0);
    in.agree_on_failure();
    in.watch.wall_force = in.walls.force();
    in.frame.give(granules);
}

void Engine::resume(particle::Store& granules, std::span<ContactRecord const> contacts)
{
    auto& in = *inside_;
    in.pairs = {};
    in.pairs.shape(in.rules.columns);
    in.walls.clear();
    in.frame.take(granules);
    in.rebuild(granules, contacts);
    in.frame.give(granules);
}

void Engine::advance(particle::Store& granules, double dt, int steps)
{
    auto& in = *inside_;
    if (steps <= 0) return;
    if (in.settings.frozen) {
        HeldGas::give_at_rest(granules, steps * dt);
        in.steps += steps;
        return;
    }
    in.frame.refresh(granules);
    in.gas.begin(granules, in.settings.gravity, 0.5 * dt);
    in.last_moved = in.first_move(dt);
    for (int k = 0; k < steps;) {
        int const together = in.steps_together(steps - k);
        if (together > 1) {
            in.sweep(dt, together, k == 0);
        } else {
            ++in.steps;
            double const moved = in.move_all(dt, k == 0 ? 1 : 2, true);
            in.stop_alone();
            in.time += dt;
            in.walls.go_to(in.time, dt);
            if (in.outgrown(moved) || in.walls.moved() > 0.5 * in.skin - in.growth) {
                in.gas.before_rows_move(granules);
                in.rebuild(granules);
                in.gas.after_rows_moved(granules);
            } else if (in.comm.size() > 1) {
                auto const timing = in.stopwatch.time(Stage::neighbours);
                in.halo.begin_refresh(in.frame);
                in.halo.end_refresh(in.frame);
            }
            in.all_forces(dt);
        }
        k += together;
    }
    in.move_all(dt, 1, false);
    in.watch.wall_force = in.walls.force();
    in.frame.give(granules);
    in.gas.end(granules, 2 * steps);
}

void Engine::changed(particle::Store& granules)
{
    auto& in = *inside_;
    in.frame.refresh(granules);
    double growth = 0;
    for (std::size_t row = 0; row < granules.owned; ++row)
        growth = std::max(growth, granules.radius[row] - in.built_radius[row]);
    in.growth = in.comm.max(growth);
    if (in.growth > 0.25 * in.skin) {
        in.rebuild(granules);
        in.frame.give(granules);
    } else if (in.comm.size() > 1) {
        in.halo.refresh_all(in.frame);
    }
}

void Engine::bring_home(particle::Store& granules)
{
    auto& in = *inside_;
    if (in.comm.max(in.strayed() ? 1L : 0L) == 0) return;
    in.rebuild(granules);
    in.frame.give(granules);
}

void Engine::rebalance(particle::Store& granules)
{
    auto& in = *inside_;
    in.balance(granules);
    in.rebuild(granules);
    in.frame.give(granules);
}

void Engine::repartition(particle::Store& granules, par::Partition partition)
{
    auto& in = *inside_;
    in.frame.give(granules);
    in.halo.partition(std::move(partition));
    ++in.watch.rebalances;
    in.rebuild(granules);
    in.frame.give(granules);
}

std::vector<double> Engine::work() const
{
    return inside_->work();
}

std::vector<Contact> Engine::contacts(double gap) const
{
    auto const& in = *inside_;
    auto const& frame = in.frame;
    base::require(gap <= in.settings.sight, "contacts with gaps of {:.3g} m are asked for, but sight ends at {:.3g} m",
                  gap, in.settings.sight);
    std::vector<Contact> out;
    auto const normal_force = [&](std::size_t pairing, double overlap, double radius, double mass, double speed) {
        law::contact::Approach<double> const at{
            .overlap = overlap, .radius = radius, .mass = mass, .inertia = 1, .speed = speed, .step = 0};
        return std::visit([&](auto const& law) { return law(in.pairings[pairing], at); }, in.settings.laws.normal);
    };
    std::size_t const materials = in.rules.materials;
    for (std::size_t b = 0; b < in.pairs.blocks(); ++b)
        for (std::size_t lane = 0; lane < kernel::block; ++lane) {
            bool const touching = in.pairs.touching(b, lane);
            auto const low = in.pairs.low(b, lane), high = in.pairs.high(b, lane);
            if (!touching && (gap <= 0 || low >= frame.rows() || high >= frame.rows())) continue;
            auto const &one = frame.bodies[low], &other = frame.bodies[high];
            Vec3 const apart = in.apart(low, high);
            double const distance = norm(apart), overlap = one.radius + other.radius - distance;
            if (!touching && overlap <= -gap) continue;
            double const speed = dot(Frame::vec(one.velocity) - Frame::vec(other.velocity), apart) / distance;
            double const reduced = one.radius * other.radius / (one.radius + other.radius);
            Contact& contact = out.emplace_back(Contact{.low = frame.id[low],
                                                        .high = frame.id[high],
                                                        .wall = false,
                                                        .overlap = touching ? overlap : std::min(overlap, 0.0),
                                                        .normal_force = 0,
                                                        .history = {},
                                                        .radius = std::min(one.radius, other.radius),
                                                        .reduced_radius = reduced,
                                                        .elastic_force = 0,
                                                        .rows = {low, high}});
            if (!touching) continue;
            auto const force = normal_force(frame.material[low] * materials + frame.material[high], overlap, reduced,
                                            1 / (one.inverse_mass + other.inverse_mass), speed);
            contact.normal_force = force.force, contact.elastic_force = force.elastic;
            contact.history = in.pairs.history(b, lane);
        }
    for (std::size_t k = 0; k < in.walls.size(); ++k) {
        if (!in.walls.touches(k)) continue;
        auto const row = in.walls.row(k), wall = in.walls.body(k);
        auto const& body = frame.bodies[row];
        double const speed = dot(Frame::vec(body.velocity) - in.walls.velocity(k), in.walls.normal(k));
        auto const force = normal_force(frame.material[row] * materials + in.settings.walls[wall].material,
                                        in.walls.overlap(k), body.radius, 1 / body.inverse_mass, speed);
        out.push_back({frame.id[row],
                       wall,
                       true,
                       in.walls.overlap(k),
                       force.force,
                       in.walls.history(k),
                       body.radius,
                       body.radius,
                       force.elastic,
                       {row, row}});
    }
    if (gap > 0)
        in.walls.for_each_beside(frame, gap, [&](std::uint32_t row, std::uint32_t wall, double distance) {
            double const radius = frame.radius(row);
            out.push_back({frame.id[row], wall, true, radius - distance, 0, {}, radius, radius, 0, {row, row}});
        });
    return out;
}

std::vector<double> Engine::known_here(std::span<double const> owned) const
{
    auto const& in = *inside_;
    std::vector<double> out(owned.begin(), owned.end());
    out.resize(in.frame.rows());
    if (in.comm.size() > 1) in.halo.spread(out);
    return out;
}

std::vector<ContactRecord> Engine::save_contacts() const
{
    auto const& in = *inside_;
    std::vector<ContactRecord> out;
    in.pairs.for_each_touching([&](std::uint32_t low, std::uint32_t high, History const& history) {
        if (low < in.frame.owned) out.push_back({in.frame.id[low], in.frame.id[high], history});
    });
    in.walls.for_each_touching([&](std::uint32_t row, Id partner, History const& history) {
        out.push_back({in.frame.id[row], ContactRecord::wall_bit | partner, history});
    });
    return out;
}

std::vector<WallLoad> Engine::wall_loads() const
{
    return inside_->walls.loads(inside_->frame, inside_->comm);
}
geometry::Pose const& Engine::pose(std::size_t body) const
{
    return inside_->walls.pose(body);
}
double Engine::time() const
{
    return inside_->time;
}
std::vector<geometry::ServoState> Engine::servos() const
{
    return inside_->walls.servos();
}
void Engine::set_clock(double time, std::vector<geometry::ServoState> const& servos)
{
    inside_->time = time;
    if (!servos.empty()) inside_->walls.servos(servos);
    inside_->walls.go_to(time, 0);
}

long Engine::candidates() const
{
    return static_cast<long>(inside_->pairs.pairs());
}
double Engine::skin() const
{
    return inside_->skin;
}
std::string Engine::kernel() const
{
    return std::string(inside_->kernel->name);
}
std::size_t Engine::bytes() const
{
    auto const& in = *inside_;
    return in.frame.bodies.capacity() * sizeof(kernel::Body) + in.gas.bytes() + in.pairs.bytes();
}
par::Partition const& Engine::partition() const
{
    return inside_->halo.partition();
}
Settings const& Engine::settings() const
{
    return inside_->settings;
}
Watch& Engine::watch()
{
    return inside_->watch;
}
base::Stopwatch& Engine::stopwatch()
{
    return inside_->stopwatch;
}
}
