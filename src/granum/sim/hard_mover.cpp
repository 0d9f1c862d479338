#include "granum/sim/hard_mover.hpp"

#include "granum/base/error.hpp"

#include <algorithm>

namespace granum::sim
{
void HardMover::advance(particle::Store& granules, double dt, int steps)
{
    auto const& seen = spheres_.watch();
    // A time-driven step moves all granules: it counts as a tenth of a meeting of each.
    auto const met = [&] {
        return 2 * static_cast<double>(seen.collisions) + static_cast<double>(seen.wall_collisions) +
               0.1 * static_cast<double>(granules.owned) * static_cast<double>(seen.time_driven_steps);
    };
    double const before = met();
    spheres_.advance(granules, dt, steps);
    met_ = met() - before;
    interval_ += dt * steps;
    watch_.largest_overlap = seen.largest_overlap;
    watch_.dissipated = {};
    watch_.dissipated.add(seen.dissipated);
}

std::vector<dem::WallLoad> HardMover::wall_loads() const
{
    auto sums = spheres_.watch().loads;
    std::vector<dem::WallLoad> out(settings().walls.size());
    for (std::size_t body = 0; interval_ > 0 && body < sums.size(); ++body) {
        auto const earlier = body < earlier_.size() ? earlier_[body] : dem::HardLoad{};
        out[body] = {(1 / interval_) * (sums[body].impulse - earlier.impulse),
                     (1 / interval_) * (sums[body].turn - earlier.turn)};
    }
    return out;
}

void HardMover::begin_interval()
{
    earlier_ = spheres_.watch().loads;
    interval_ = 0;
}

double HardMover::next_step(particle::Store const& granules, double dt, double before) const
{
    double const wanted = met_ > 0 ? 5 * static_cast<double>(granules.owned) * dt / met_ : 4 * before;
    return std::clamp(wanted, 0.25 * before, 4 * before);
}

template <class Visit>
void HardMover::each_number(dem::HardMemory& memory, Visit&& visit)
{
    auto& seen = spheres_.watch();
    visit(memory.pace.collisions), visit(memory.pace.since), visit(memory.packed_steps), visit(interval_);
    visit(seen.collisions), visit(seen.wall_collisions), visit(seen.kept_elastic), visit(seen.largest_overlap);
    visit(seen.dissipated), visit(seen.collapses), visit(seen.time_driven), visit(seen.time_driven_steps);
    visit(seen.held_back);
}

io::Sections HardMover::save()
{
    auto memory = spheres_.memory();
    std::vector<double> numbers;
    each_number(memory, [&](auto const& number) { numbers.push_back(static_cast<double>(number)); });
    return {io::section_of("hard.last", memory.last), io::section_of("hard.numbers", numbers),
            io::section_of("hard.loads", spheres_.watch().loads), io::section_of("hard.earlier", earlier_)};
}

void HardMover::resume(particle::Store& granules, io::Sections const& saved)
{
    dem::HardMemory memory{.last = io::values_of<double>(io::find_section(saved, "hard.last")), .pace = {}};
    auto const numbers = io::values_of<double>(io::find_section(saved, "hard.numbers"));
    each_number(memory, [&, at = std::size_t{0}](auto& number) mutable {
        if (at >= numbers.size()) throw base::IoError("a checkpoint that holds fewer numbers than this version needs");
        number = static_cast<std::decay_t<decltype(number)>>(numbers[at++]);
    });
    spheres_.watch().loads = io::values_of<dem::HardLoad>(io::find_section(saved, "hard.loads"));
    earlier_ = io::values_of<dem::HardLoad>(io::find_section(saved, "hard.earlier"));
    if (memory.last.size() != granules.owned)
        throw base::IoError("a checkpoint whose collisions are not those of its granules");
    spheres_.resume(granules, memory);
}
}
