// What the laws of a contact are given and what they answer: numbers only, no granules.
//
// Laws are templates over Real, a double or a register of doubles that belong to as many contacts (math/real.hpp), so
// that one source serves the plain loop and the vectorised one. They never branch on a Real.
#pragma once

#include "granum/math/triple.hpp"

#include <cmath>

namespace granum::law::contact
{
using math::abs;
using math::any;
using math::inverse_fourth_root;
using math::max;
using math::min;
using math::mul_add;
using math::neg_mul_add;
using math::reciprocal;
using math::reciprocal_sqrt;
using math::select;
using math::sqrt;
using math::Triple;

//! Tangential over normal stiffness, with what laws would have to compute from it again and again.
template <class Real = double>
struct Ratio
{
    Real value{}, root{}, inverse{};

    Ratio() = default;
    explicit Ratio(double ratio) : value(ratio), root(std::sqrt(ratio)), inverse(ratio > 0 ? 1 / ratio : 0) {}
};

//! Effective properties of two materials that touch.
template <class Real = double>
struct Pair
{
    Real youngs_modulus{};      //!< E*, Pa
    Ratio<Real> tangential{};   //!< k_t / k_n at any overlap: 4 G* / E* of elastic spheres
    Real damping{};             //!< g of the normal dashpot, chosen by the normal law for the restitution, 1
    Real tangential_damping{};  //!< g_t of the tangential dashpot c_t = 2 g_t sqrt(k_t m*), 1
    Real sliding_friction{};    //!< 1
    Real rolling_friction{};    //!< 1
    Real rolling_damping{};     //!< eta_r of the rolling dashpot, 1
    Real stiffness{};           //!< k_n of the linear spring, N/m
    Real dissipation_time{};    //!< A of the viscoelastic law, s

    static constexpr int size = 11;

    //! Calls `what` with a reference to each member, always in this order: a table of pairs is read generically.
    template <class What>
    void visit(What&& what)
    {
        what(youngs_modulus), what(tangential.value), what(tangential.root), what(tangential.inverse);
        what(damping), what(tangential_damping), what(sliding_friction), what(rolling_friction);
        what(rolling_damping), what(stiffness), what(dissipation_time);
    }
};

//! Two spheres, or a sphere and a wall (then radius, mass and inertia are those of the sphere).
template <class Real>
struct Approach
{
    Real overlap;                          //!< m, >= 0
    Real radius;                           //!< R* = R_i R_j / (R_i + R_j), m
    Real mass;                             //!< m* = m_i m_j / (m_i + m_j), kg
    Real inverse_mass = reciprocal(mass);  //!< 1/kg
    Real inertia;                          //!< I_i I_j / (I_i + I_j) with I = 1.4 m R^2 about the contact point, kg m2
    Real speed;  //!< relative velocity along the normal in the middle of the last step, positive when they part, m/s
    Real step;   //!< length of the last step, s; 0: forces only, histories stay
};

//! Answer of a normal law.
template <class Real>
struct NormalForce
{
    Real force;                  //!< N, positive pushes apart
    Real elastic;                //!< its conservative part, N
    Real energy;                 //!< stored elastically, J
    Real tangential_stiffness;   //!< k_t at this overlap, N/m
    Real tangential_compliance;  //!< 1 / k_t, m/N; finite where k_t is zero
    Real tangential_impedance;   //!< sqrt(k_t m*), N s/m
};

//! Slope of the normal force over the overlap, and what dashpots and tangential springs derive from it.
template <class Real>
struct Slope
{
    Real stiffness;   //!< k_n, N/m
    Real compliance;  //!< 1 / k_n, m/N
    Real impedance;   //!< sqrt(k_n m*), N s/m
};

//! The answer of a normal law that pushes with `force`, of it `elastic` conservative with `energy`, and has this slope.
template <class Real>
NormalForce<Real> normal_force(Pair<Real> const& pair, Real force, Real elastic, Real energy, Slope<Real> const& slope)
{
    auto const& ratio = pair.tangential;
    return {force,
            elastic,
            energy,
            ratio.value * slope.stiffness,
            ratio.inverse * slope.compliance,
            ratio.root * slope.impedance};
}

//! Answer of a tangential law.
template <class Real>
struct TangentialForce
{
    Triple<Real> force;  //!< on the first partner, N
    Real work;           //!< done on the contact by the motion in this step, J
};

//! Answer of a rolling law.
template <class Real>
struct RollingTorque
{
    Triple<Real> torque;  //!< on the first partner, N m
    Real energy;          //!< stored elastically, J
    Real work;            //!< done on the contact by the motion in this step, J
};

//! A divisor below every one that means something: keeps lanes without a contact finite.
inline constexpr double tiny = 1e-300;

//! Turns a tangential history vector into the plane normal to `n` without changing its length.
template <class Real>
Triple<Real> turned_into_plane(Triple<Real> const& history, Triple<Real> const& n)
{
    Real const along = dot(history, n);
    Triple<Real> const flat = neg_mul_add(along, n, history);
    Real const flat2 = norm2(flat), whole2 = mul_add(along, along, flat2), product = flat2 * whole2;
    return (whole2 * reciprocal_sqrt(max(product, Real(tiny)))) * flat;
}

//! The factor that brings a vector of squared length `size2` down to `limit` where it is longer (`within` false), 1
//! elsewhere.
template <class Real, class Mask>
Real shortening(Mask within, Real limit, Real size2)
{
    return select(within, Real(1), limit * reciprocal_sqrt(max(size2, Real(tiny))));
}
}
