// What the gas, held during a coupling interval, does to granules in each kick: a row per granule, made of the store's
// columns at the beginning of the interval and told to them at its end.
//
// With mass m, added mass a, drag rate r, gas velocity u, held force G, contact force F, gravity g and h = dt/2
//
//     v <- (v + h (F/(m + a) + A + r u)) / (1 + h r),   A = (G + m g)/(m + a),   impulse += (m + a) h r (u - v),
//     w <- (w + h (T/I + q W)) / (1 + h q),             spin impulse += I h q (W - w),
//
// and likewise for the spin w with the torque T, the moment of inertia I, the rate q and the gas's spin W. A row sums
// what gas and gravity gave to the velocity; the impulse of the drag is what is left of it without A. Granules of a
// rate of zero get none, to the bit. While the interval lasts, the columns of the impulses hold these sums (m/s and
// rad/s) when rows move: so where and when they move is seen in no bit of an impulse.
#pragma once

#include "granum/base/aligned.hpp"
#include "granum/dem/kernel/kernel.hpp"
#include "granum/particle/store.hpp"

namespace granum::dem
{
using math::Vec3;

class HeldGas
{
  public:
    //! An interval of kicks of `half` (s) begins.
    void begin(particle::Store const& granules, Vec3 const& gravity, double half);
    //! Between the two, rows of the store may change their places.
    void before_rows_move(particle::Store& granules) const { keep(granules); }
    void after_rows_moved(particle::Store const& granules) { load(granules, false); }
    //! Adds what granules got in the `kicks` of the interval to their impulses.
    void end(particle::Store& granules, int kicks) const;

    //! @{ Of the owned rows; null where gas does nothing to any.
    kernel::Drag* of_velocities() { return velocities_.empty() ? nullptr : velocities_.data(); }
    kernel::Drag* of_spins() { return spins_.empty() ? nullptr : spins_.data(); }
    //! @}

    std::size_t bytes() const { return (velocities_.capacity() + spins_.capacity()) * sizeof(kernel::Drag); }

    //! What the gas gives to granules that do not move in `time` (s).
    static void give_at_rest(particle::Store& granules, double time);

  private:
    void load(particle::Store const& granules, bool at_first);
    void keep(particle::Store& granules) const;

    Vec3 gravity_;
    double half_ = 0;
    base::AlignedVector<kernel::Drag> velocities_, spins_;
};
}
