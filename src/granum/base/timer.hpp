// Wall time per stage of the step: a scope adds its time to a named slot.
#pragma once

#include <array>
#include <chrono>
#include <string_view>

namespace granum::base
{
enum class Stage
{
    contacts,
    neighbours,
    gas,
    exchange,
    spray_and_drying,
    output,
    count
};
inline constexpr std::array<std::string_view, static_cast<std::size_t>(Stage::count)> stage_names{
    "contacts", "neighbours", "gas", "exchange", "spray_and_drying", "output"};

//! Seconds spent in each stage on this rank.
class Stopwatch
{
  public:
    class Scope
    {
      public:
        Scope(double& slot) : slot_(slot), start_(std::chrono::steady_clock::now()) {}
        ~Scope() { slot_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
        Scope(Scope const&) = delete;
        Scope& operator=(Scope const&) = delete;

      private:
        double& slot_;
        std::chrono::steady_clock::time_point start_;
    };

    [[nodiscard]] Scope time(Stage stage) { return Scope(seconds_[static_cast<std::size_t>(stage)]); }
    double seconds(Stage stage) const { return seconds_[static_cast<std::size_t>(stage)]; }

  private:
    std::array<double, static_cast<std::size_t>(Stage::count)> seconds_{};
};
}
