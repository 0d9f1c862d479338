// What the laws of a contact are given and what they keep: numbers only, no granules.
#pragma once

#include "granum/math/vec3.hpp"

namespace granum::law::contact
{
using math::Vec3;

//! Effective properties of two materials that touch.
struct Pair
{
    double youngs_modulus = 0;    //!< E*, Pa
    double shear_modulus = 0;     //!< G*, Pa
    double damping = 0;           //!< g of c = 2 g sqrt(S m*), chosen by the normal law for the restitution, 1
    double sliding_friction = 0;  //!< 1
    double rolling_friction = 0;  //!< 1
};

//! Two spheres, or a sphere and a wall (then radius and mass are those of the sphere).
struct Approach
{
    double overlap;  //!< m, > 0
    double radius;   //!< R* = R_i R_j / (R_i + R_j), m
    double mass;     //!< m* = m_i m_j / (m_i + m_j), kg
    double speed;    //!< relative velocity along the normal, positive when they separate, m/s
};

//! Answer of a normal law.
struct NormalForce
{
    double force;           //!< N, positive pushes apart
    double elastic;         //!< its conservative part, N
    double energy;          //!< stored elastically, J
    double contact_radius;  //!< sqrt(R* overlap), m
};

//! What a tangential law keeps from step to step.
struct Slip
{
    Vec3 displacement;     //!< of the first partner against the second, m
    double stiffness = 0;  //!< at the step before, N/m
};

//! Answer of a tangential law.
struct TangentialForce
{
    Vec3 force;        //!< on the first partner, N
    double stiffness;  //!< N/m
    double energy;     //!< stored elastically, J
    double work;       //!< done on the contact by the motion in this step, J
};

//! Answer of a rolling law; the torque itself is its history.
struct RollingTorque
{
    double energy = 0;  //!< stored elastically, J
    double work = 0;    //!< done on the contact by the motion in this step, J
};

//! Turns a tangential history vector into the plane normal to `n` without changing its length.
inline Vec3 turned_into_plane(Vec3 const& history, Vec3 const& n)
{
    Vec3 const flat = history - dot(history, n) * n;
    double const flat2 = norm2(flat);
    return flat2 > 0 ? std::sqrt(norm2(history) / flat2) * flat : Vec3{};
}
}
