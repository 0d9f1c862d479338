#include "granum/geometry/wall_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace granum::geometry
{
namespace
{
constexpr double least_edge = 0.95;  // cosine of the angle between two planes: 18 degrees

//! Whether a sample is what a model says. Beyond an edge the distance is that of the edge, which no plane tells: then
//! the foot on the wall must lie on both planes of the model.
bool agrees(WallModel const& model, Sample const& sample, double tolerance)
{
    double const said = model.at(sample.at);
    if (std::abs(said - sample.distance) <= tolerance) return true;
    if (model.kind == WallModel::Kind::one || (said > 0) != (sample.distance > 0)) return false;
    Vec3 const foot = sample.at - sample.distance * sample.normal;
    return std::abs(model.first.at(foot)) <= tolerance && std::abs(model.second.at(foot)) <= tolerance;
}

//! Looks for the wall in one box or rectangle.
class Fitter
{
  public:
    Fitter(Region const& region, Vec3 const& middle, Vec3 const& half, std::span<Sample const> samples,
           Tolerance const& tolerance)
        : region_(region), middle_(middle), half_(half), samples_(samples), tolerance_(tolerance)
    {
    }

    std::optional<WallModel> one()
    {
        WallModel model{.kind = WallModel::Kind::one, .first = samples_[0].plane()};
        if (!good(model)) return std::nullopt;
        look_at_corners();
        if (!good(model)) return std::nullopt;
        // A curved wall bends away from its tangent: by the mean over the box, which is 4/3 of that over the middles of
        // its parts.
        double bend = 0;
        for (auto const& part : samples_.subspan(1)) bend += part.distance - model.first.at(part.at);
        model.first.offset += 4.0 / 3 * bend / static_cast<double>(samples_.size() - 1);
        return model;
    }

    std::optional<WallModel> two()
    {
        for (auto const& place : samples_) collect(place);
        for (auto const& place : corners()) collect(place);
        for (std::size_t i = 0; i < planes_; ++i)
            for (std::size_t k = i + 1; k < planes_; ++k) {
                if (dot(plane_[i].slope, plane_[k].slope) > least_edge) continue;  // one wall that is curved
                for (auto const kind : {WallModel::Kind::both, WallModel::Kind::either}) {
                    WallModel model{.kind = kind, .first = plane_[i], .second = plane_[k]};
                    if (!good(model)) continue;
                    if (corners_known_ == 0) look_at_corners();
                    if (!good(model)) continue;
                    bend(model);
                    return model;
                }
            }
        return std::nullopt;
    }

  private:
    std::span<Sample const> corners() const { return std::span(corners_).first(corners_known_); }

    bool good(WallModel const& model) const
    {
        auto const all_agree = [&](std::span<Sample const> places, double tolerance) {
            return std::all_of(places.begin(), places.end(),
                               [&](Sample const& one) { return agrees(model, one, tolerance); });
        };
        return all_agree(samples_, tolerance_.inside) && all_agree(corners(), tolerance_.corners);
    }

    //! Moves each plane by the mean of what the samples nearest to it say, for walls that are curved.
    void bend(WallModel& model) const
    {
        double of_first = 0, of_second = 0;
        int first = 0, second = 0;
        for (auto const& one : samples_) {
            double const off = one.distance - model.at(one.at);
            if (std::abs(off) > tolerance_.inside) continue;
            if (model.at(one.at) == model.first.at(one.at))
                of_first += off, ++first;
            else
                of_second += off, ++second;
        }
        if (first > 0) model.first.offset += of_first / first;
        if (second > 0) model.second.offset += of_second / second;
    }

    void look_at_corners()
    {
        std::size_t const flat = half_.x == 0 ? 0 : half_.y == 0 ? 1 : half_.z == 0 ? 2 : 3;
        for (std::size_t k = 0; k < 8; ++k) {
            if (flat < 3 && (k >> flat & 1) != 0) continue;
            Vec3 at = half_;
            for (std::size_t d = 0; d < 3; ++d)
                if ((k >> d & 1) == 0) at[d] = -at[d];
            corners_[corners_known_++] = sample(region_, middle_, at);
        }
    }

    //! Takes the plane of a sample, if it is a new one and no tangent of an edge: behind a face the distance goes on,
    //! behind an edge it turns.
    void collect(Sample const& place)
    {
        if (planes_ == plane_.size()) return;
        Linear const plane = place.plane();
        for (std::size_t k = 0; k < planes_; ++k)
            if (dot(plane.slope, plane_[k].slope) > 0.999 &&
                std::abs(plane_[k].at(place.at) - place.distance) < tolerance_.inside)
                return;
        double const through = std::copysign(0.05 * tolerance_.inside, -place.distance);
        Vec3 const behind = place.at + (through - place.distance) * place.normal;
        if (std::abs(region_.distance(middle_ + behind) - through) < 0.02 * std::abs(through))
            plane_[planes_++] = plane;
    }

    Region const& region_;
    Vec3 middle_, half_;
    std::span<Sample const> samples_;
    Tolerance tolerance_;
    std::array<Sample, 8> corners_{};
    std::size_t corners_known_ = 0;
    std::array<Linear, 4> plane_{};
    std::size_t planes_ = 0;
};
}

std::optional<WallModel> fit(Region const& region, Vec3 const& middle, Vec3 const& half,
                             std::span<Sample const> samples, Tolerance const& tolerance)
{
    Fitter fitter(region, middle, half, samples, tolerance);
    if (auto const model = fitter.one()) return model;
    return fitter.two();
}
}
