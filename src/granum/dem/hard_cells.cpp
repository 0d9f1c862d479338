#include "granum/dem/hard_cells.hpp"

#include "granum/math/first_fall.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
void HardCells::build(HardState const& state, double time, double margin)
{
    std::size_t const number = state.size();
    periodic_ = state.periodic;
    place_.resize(number);
    next_.assign(number, -1);
    previous_.assign(number, -1);
    if (number == 0) {
        levels_ = 0;
        return;
    }
    double smallest = state.body[0].radius, largest = smallest;
    Vec3 low = state.position(0, time), high = low;
    for (std::size_t i = 0; i < number; ++i) {
        smallest = std::min(smallest, state.body[i].radius);
        largest = std::max(largest, state.body[i].radius);
        Vec3 const x = state.position(i, time);
        for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
    }
    for (std::size_t d = 0; d < 3; ++d)
        if (periodic_[d]) low[d] = state.lower[d], high[d] = state.upper[d];
    origin_ = low;
    for (std::size_t d = 0; d < 3; ++d) extent_[d] = std::max(high[d] - low[d], 2 * largest);

    levels_ = 1 + static_cast<int>(std::floor(std::log2(largest / smallest)));
    filled_.assign(static_cast<std::size_t>(levels_), 0);
    for (std::size_t i = 0; i < number; ++i) {
        int const down = static_cast<int>(std::floor(std::log2(largest / state.body[i].radius)));
        place_[i].level = std::clamp(levels_ - 1 - down, 0, levels_ - 1);
        ++filled_[static_cast<std::size_t>(place_[i].level)];
    }
    // About one sphere to a cell on the fullest level, cells never narrower than the largest diameter of their level.
    auto const fullest = std::max_element(filled_.begin(), filled_.end()) - filled_.begin();
    double const room =
        extent_.x * extent_.y * extent_.z / static_cast<double>(filled_[static_cast<std::size_t>(fullest)]);
    double wanted = std::max(2 * largest * (1 + 1e-9) + margin * std::exp2(levels_ - 1),
                             std::cbrt(0.5 * room) * std::exp2(levels_ - 1 - fullest));
    count_.resize(static_cast<std::size_t>(levels_));
    width_.resize(static_cast<std::size_t>(levels_));
    begin_.resize(static_cast<std::size_t>(levels_));
    std::size_t const most = 16 * number + 4096;
    for (std::size_t total = most + 1; total > most; wanted *= 1.26) {
        total = 0;
        for (int level = levels_ - 1; level >= 0; --level) {
            auto const l = static_cast<std::size_t>(level);
            begin_[l] = total;
            std::size_t cells = 1;
            for (std::size_t d = 0; d < 3; ++d) {
                int const coarse = static_cast<int>(std::clamp(std::floor(extent_[d] / wanted), 1.0, 1e5));
                count_[l][d] = coarse << (levels_ - 1 - level);
                width_[l][d] = extent_[d] / count_[l][d];
                cells *= static_cast<std::size_t>(count_[l][d]);
            }
            total += cells;
        }
        head_.assign(total <= most ? total : 0, -1);
    }
    for (std::size_t i = number; i-- > 0;) {
        auto const l = static_cast<std::size_t>(place_[i].level);
        Vec3 const x = state.position(i, time);
        for (std::size_t d = 0; d < 3; ++d)
            place_[i].cell[d] =
                std::clamp(static_cast<int>(std::floor((x[d] - origin_[d]) / width_[l][d])), 0, count_[l][d] - 1);
        insert(i);
    }
}

void HardCells::insert(std::size_t i)
{
    int& head = head_[index(place_[i].level, place_[i].cell)];
    previous_[i] = -1;
    next_[i] = head;
    if (head >= 0) previous_[static_cast<std::size_t>(head)] = static_cast<int>(i);
    head = static_cast<int>(i);
}

void HardCells::remove(std::size_t i)
{
    if (previous_[i] >= 0)
        next_[static_cast<std::size_t>(previous_[i])] = next_[i];
    else
        head_[index(place_[i].level, place_[i].cell)] = next_[i];
    if (next_[i] >= 0) previous_[static_cast<std::size_t>(next_[i])] = previous_[i];
}

HardCells::Exit HardCells::exit(HardState const& state, std::size_t i) const
{
    HardBody const& body = state.body[i];
    Place const& place = place_[i];
    auto const l = static_cast<std::size_t>(place.level);
    Vec3 const& a = state.acceleration(i);
    Exit out{math::never, -1, 0};
    for (std::size_t d = 0; d < 3; ++d) {
        double const low = origin_[d] + place.cell[d] * width_[l][d];
        for (int const side : {-1, 1}) {
            bool const outermost = side < 0 ? place.cell[d] == 0 : place.cell[d] == count_[l][d] - 1;
            if (outermost && !periodic_[d]) continue;
            double const gap = side < 0 ? body.x[d] - low : low + width_[l][d] - body.x[d];
            double const time = math::first_fall(gap, -side * body.v[d], -0.5 * side * a[d]);
            if (time < out.time) out = {time, static_cast<int>(d), side};
        }
    }
    out.time += body.t;
    return out;
}

void HardCells::pass(HardState& state, std::size_t i, Exit const& through)
{
    remove(i);
    auto const d = static_cast<std::size_t>(through.axis);
    Place& place = place_[i];
    int const n = count_[static_cast<std::size_t>(place.level)][d];
    int& cell = place.cell[d];
    cell += through.side;
    if (cell < 0) cell = n - 1, state.body[i].x[d] += extent_[d];
    if (cell >= n) cell = 0, state.body[i].x[d] -= extent_[d];
    insert(i);
}
}
