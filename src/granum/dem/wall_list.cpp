#include "granum/dem/wall_list.hpp"

#include <algorithm>
#include <optional>

namespace granum::dem
{
using kernel::block;

void WallList::make(Frame const& frame, std::vector<geometry::Wall> const& walls, double skin,
                    std::function<std::uint32_t(std::uint32_t)> const& row_now)
{
    struct Known
    {
        std::uint32_t row, wall;
        History history;
    };
    std::vector<Known> known;
    for_each_touching([&](std::uint32_t row, std::uint32_t wall, History const& history) {
        if (auto const now = row_now(row); now < frame.owned) known.push_back({now, wall, history});
    });
    rows_.clear();
    wall_.clear();
    for (std::uint32_t row = 0; row < frame.owned; ++row)
        for (std::uint32_t wall = 0; wall < walls.size(); ++wall)
            if (touch(walls[wall].surface, frame.position(row), frame.radius(row) + skin)) {
                rows_.push_back(row);
                wall_.push_back(wall);
            }
    size_ = rows_.size();
    std::size_t const places = (size_ + block - 1) / block * block;
    rows_.resize(places, frame.lonely());
    wall_.resize(places, 0);
    material_.resize(places);
    for (std::size_t k = 0; k < places; ++k)
        material_[k] = walls.empty() ? 0 : static_cast<std::uint8_t>(walls[wall_[k]].material);
    history_.assign(places * columns_, 0.0);
    overlap_.assign(places, 0.0);
    touching_.assign(places / block, 0);
    for (std::size_t d = 0; d < 3; ++d)
        for (auto* numbers : {&normal_[d], &velocity_[d], &spin_[d], &force_[d], &torque_[d]})
            numbers->assign(places, 0.0);
    for (auto const& [row, wall, history] : known) {
        if (find(row, wall) < size_)
            set(row, wall, history);
        else if (columns_ > 6)
            lost_energy_ += history[columns_ - 1];
    }
}

std::size_t WallList::find(std::uint32_t row, std::uint32_t wall) const
{
    auto const end = rows_.begin() + static_cast<std::ptrdiff_t>(size_);
    auto k = static_cast<std::size_t>(std::lower_bound(rows_.begin(), end, row) - rows_.begin());
    while (k < size_ && rows_[k] == row && wall_[k] != wall) ++k;
    return k < size_ && rows_[k] == row ? k : size_;
}

void WallList::set(std::uint32_t row, std::uint32_t wall, History const& history)
{
    std::size_t const k = find(row, wall);
    if (k == size_) return;
    for (std::size_t c = 0; c < columns_; ++c) history_[(k / block * columns_ + c) * block + k % block] = history[c];
    touching_[k / block] = static_cast<std::uint8_t>(touching_[k / block] | 1u << (k % block));
}

History WallList::history(std::size_t k) const
{
    History out{};
    for (std::size_t c = 0; c < columns_; ++c) out[c] = history_[(k / block * columns_ + c) * block + k % block];
    return out;
}

void WallList::measure(Frame const& frame, std::vector<geometry::Wall> const& walls)
{
    constexpr std::size_t most = 16;  // walls that one granule can be near
    for (std::size_t begin = 0, end = 0; begin < size_; begin = end) {
        auto const row = rows_[begin];
        while (end < size_ && rows_[end] == row) ++end;
        std::size_t const last = std::min(end, begin + most);
        double const radius = frame.radius(row);
        std::array<std::optional<geometry::Touch>, most> touches;
        for (std::size_t k = begin; k < last; ++k)
            touches[k - begin] = geometry::touch(walls[wall_[k]].surface, frame.position(row), radius);
        for (std::size_t k = begin; k < last; ++k) {
            auto const& touch = touches[k - begin];
            bool accepted = touch.has_value();
            // The end of a section counts only where the section that goes on from there is not touched itself.
            if (accepted && touch->edge)
                for (std::size_t other = begin; other < last; ++other) {
                    auto const& rival = touches[other - begin];
                    if (other == k || !rival) continue;
                    if (rival->edge && other > k) continue;  // of two equal edges the first stays
                    if (dot(rival->normal, touch->normal) > (rival->edge ? 0.99 : 0.8)) accepted = false;
                }
            overlap_[k] = accepted ? radius - touch->distance : 0;
            if (!accepted) continue;
            normal_[0][k] = touch->normal.x, normal_[1][k] = touch->normal.y, normal_[2][k] = touch->normal.z;
        }
    }
}

void WallList::run(kernel::Kernel const& kernel, kernel::Rules const& rules, Frame& frame,
                   std::vector<geometry::Wall> const& walls, double dt, kernel::Seen& seen)
{
    if (size_ == 0) return;
    measure(frame, walls);
    kernel.walls({.rules = &rules,
                  .bodies = frame.bodies.data(),
                  .material = frame.material.data(),
                  .sums = frame.sums.data(),
                  .blocks = touching_.size(),
                  .row = rows_.data(),
                  .wall_material = material_.data(),
                  .overlap = overlap_.data(),
                  .normal = {normal_[0].data(), normal_[1].data(), normal_[2].data()},
                  .velocity = {velocity_[0].data(), velocity_[1].data(), velocity_[2].data()},
                  .spin = {spin_[0].data(), spin_[1].data(), spin_[2].data()},
                  .history = history_.data(),
                  .touching = touching_.data(),
                  .dt = dt,
                  .force = {force_[0].data(), force_[1].data(), force_[2].data()},
                  .torque = {torque_[0].data(), torque_[1].data(), torque_[2].data()}},
                 seen);
}

Vec3 WallList::force() const
{
    Vec3 sum;
    for (std::size_t k = 0; k < size_; ++k) sum += {force_[0][k], force_[1][k], force_[2][k]};
    return sum;
}
}
