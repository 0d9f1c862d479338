#include "granum/coupling/histories.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cstring>

namespace granum::coupling
{
namespace
{
// A window is resampled for steps of up to this ratio to the one before; beyond it histories begin anew.
constexpr double widest_change = 2;
}

void Histories::set_step(double dt)
{
    if (window_ && window_->step() == dt) return;
    if (!window_ || dt > widest_change * window_->step() || window_->step() > widest_change * dt) {
        window_.emplace(intervals_, dt);
        states_.clear();
        return;
    }
    auto const before = *window_;
    window_ = before.with_step(dt);
    for (auto& [id, state] : states_) window_->resample(std::span(state).first(window_->size()), before);
}

Vec3 Histories::known(particle::Id id, Vec3 const& slip)
{
    std::size_t const size = window_->size();
    auto [found, fresh] = states_.try_emplace(id, size + 3, 0.0);
    auto& state = found->second;
    auto const window = std::span(state).first(size);
    if (!fresh) {
        Vec3 const last{state[size], state[size + 1], state[size + 2]};
        window_->advance(window, (1 / window_->step()) * (slip - last));
    }
    for (std::size_t d = 0; d < 3; ++d) state[size + d] = slip[d];
    return window_->known(window);
}

void Histories::take(particle::Id id, std::vector<std::byte>& bytes)
{
    auto const found = states_.find(id);
    if (found == states_.end()) return;
    auto const all = std::as_bytes(std::span(found->second));
    bytes.insert(bytes.end(), all.begin(), all.end());
    states_.erase(found);
}

void Histories::give(particle::Id id, std::span<std::byte const> bytes)
{
    if (bytes.empty()) return;
    std::vector<double> state(bytes.size() / sizeof(double));
    std::memcpy(state.data(), bytes.data(), bytes.size());
    states_[id] = std::move(state);
}

void Histories::save(std::vector<particle::Id>& ids, std::vector<double>& values) const
{
    for (auto const& [id, state] : states_) ids.push_back(id);
    std::sort(ids.begin(), ids.end());
    for (auto const id : ids) {
        auto const& state = states_.at(id);
        values.insert(values.end(), state.begin(), state.end());
    }
}

void Histories::recall(double step, std::vector<particle::Id> const& ids, std::vector<double> const& values)
{
    states_.clear();
    window_.reset();
    if (step > 0) window_.emplace(intervals_, step);
    if (ids.empty()) return;
    std::size_t const size = values.size() / ids.size();
    base::require(window_ && size == window_->size() + 3, "histories of {} values each do not fit the window", size);
    for (std::size_t k = 0; k < ids.size(); ++k)
        states_[ids[k]].assign(values.begin() + static_cast<std::ptrdiff_t>(k * size),
                               values.begin() + static_cast<std::ptrdiff_t>((k + 1) * size));
}
}
