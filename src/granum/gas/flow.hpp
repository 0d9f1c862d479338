// The gas: volume-averaged moist air on the cut cells of a rank.
//
// Stored state is what is conserved: mass, vapour and enthalpy of the gas in each cell (kg, kg, J; voidage and cut
// volume included) and the velocity on the faces. Temperature, mass fractions and density follow from it.
//
// A step is: momentum predictor on the faces (staggered grid); projection onto mass fluxes that bring each cell to the
// mass its equation of state asks for at the end of the step; vapour, tracer and heat carried by these same fluxes.
// What is stored changes by fluxes and sources only: conservation does not hang on any tolerance. Convection is
// implicit upwind, which any step allows, brought to second order as far as no new extremes appear (limit.hpp).
#pragma once

#include "granum/gas/settings.hpp"
#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"
#include "granum/solve/pressure.hpp"

#include <memory>
#include <optional>

namespace granum::gas
{
using grid::FaceField;
using grid::Field;

//! Least and largest value that a scalar has had anywhere.
struct Range
{
    double least, most;
};

//! Conserved and derived state. Every field has ghosts.
struct State
{
    Field mass, vapour, tracer,
        enthalpy;                     //!< kg, kg, kg, J per cell; enthalpy zero: dry air and liquid water at 0 degC
    FaceField velocity;               //!< interstitial, m/s
    FaceField mass_flux;              //!< through the lower faces in the last step, kg/s
    FaceField earlier_flux;           //!< in the one before
    double last_step = 0;             //!< s; 0: none yet
    Field pressure;                   //!< Pa above Settings::pressure, hydrostatic part included
    double static_pressure = 101325;  //!< Pa, absolute: what the equation of state of a low-Mach gas takes
    Field voidage;                    //!< of the open volume
    Field temperature, vapour_fraction, tracer_fraction, density;  //!< derived: K, kg/kg, kg/kg, kg/m3
    Range temperatures{}, vapour_fractions{}, tracer_fractions{};  //!< seen so far
    bool turbulent = false;  //!< whether the model transports what follows, which is empty otherwise
    Field energy_of_eddies;  //!< k per mass, m2/s2
    Field rate_of_eddies;    //!< epsilon, m2/s3, or omega, 1/s

    //! All fields by name.
    std::vector<std::pair<std::string, Field*>> fields();
};

//! What others do to the gas during one step; cleared by `clear`. Per cell, not per volume.
struct Sources
{
    Field drag_coefficient;              //!< kg/s: sum of the parcels' effective coefficients
    std::array<Field, 3> drag_momentum;  //!< N: sum of coefficient times parcel velocity
    std::array<Field, 3> force;          //!< N, explicit: nozzle, droplets, carried drag
    std::array<Field, 3> couple;         //!< N m, explicit: torque on the gas
    Field mass, vapour;                  //!< kg/s; gas enters at rest, its momentum belongs into `force`
    Field enthalpy;                      //!< W, explicit, with the enthalpy of what enters
    Field heat_coefficient;              //!< W/K, implicit: Q = heat_value - heat_coefficient (T - 273.15)
    Field heat_value;                    //!< W
    void clear(grid::Grid const& grid);
};

//! What passed the boundaries in the last step (this rank's share), for the ledgers. `in` is the inlets; `out` is the
//! outlets, net of what was drawn in there.
struct Balance
{
    double mass_in = 0, mass_out = 0, vapour_in = 0, vapour_out = 0, tracer_in = 0, tracer_out = 0;  //!< kg
    double enthalpy_in = 0, enthalpy_out = 0;                                                        //!< J
    double wall_heat = 0;      //!< J that the gas gave to walls
    double pressure_work = 0;  //!< J that a change of the pressure gave to the gas
    int pressure_iterations = 0;
    int sweeps = 0;  //!< over the nodes of one field, of momentum, vapour and heat
    bool pressure_converged = true;
};

//! Turbulence of the gas in the cells, ghosts filled.
struct Eddies
{
    Field energy, dissipation;      //!< k, m2/s2; epsilon, m2/s3
    std::array<Field, 3> gradient;  //!< of k, m/s2
};

//! Weights of the lower and upper face of each cell by direction: one half, but all on the other where one is a
//! boundary or closed. A force on the gas of a cell is spread with them, and the pressure gradient of a cell is
//! gathered. Drag goes by halves to both faces, as the mean velocity of a cell is that of its two faces, walls at rest
//! included: what falls to a wall or an inlet is theirs to bear.
struct FaceWeights
{
    std::array<Field, 3> lower, upper;
};

class Solver
{
  public:
    Solver(Settings settings, grid::Grid const& grid, par::Communicator const& comm);
    ~Solver();

    //! State with the given voidage, temperature (K) and vapour fraction; hydrostatic pressure. The inlets' faces have
    //! the inlets' velocity. Collective.
    State start(Field const& voidage, Field const& temperature, double vapour_fraction, Vec3 velocity) const;

    //! One step: momentum, pressure, vapour, tracer, enthalpy. `voidage` is that at the end of the step; `sources` of
    //! owned cells are read. Throws base::NumericsError with field, cell and position where a number is not finite or a
    //! cell runs out of gas. Collective.
    Balance advance(State& state, Sources const& sources, Field const& voidage, double dt);

    //! Step with Courant number `courant` at the largest velocity component, s; infinite for gas at rest. Collective.
    double courant_step(State const& state, double courant) const;

    //! grad p - div tau of the cells, Pa/m: means of the faces by FaceWeights, ghosts filled, with the stress of the
    //! last step. A granule of volume V takes the force -V (grad p - div tau) beside its drag in model A. Collective.
    std::array<Field, 3> cell_pressure_gradient(State const& state) const;
    //! Velocity of the cells, m/s: means of their two faces, ghosts filled. Collective.
    std::array<Field, 3> cell_velocity(State const& state) const;
    //! Curl of the velocity in the cells, 1/s, ghosts filled. Collective.
    std::array<Field, 3> cell_vorticity(State const& state) const;
    //! Acceleration Du/Dt of the gas in the cells in the last step, m/s2, ghosts filled. Collective.
    std::array<Field, 3> cell_acceleration(State const& state) const;

    //! Of the gas as it is now, m2/s; empty where the model is laminar. Collective.
    Field eddy_viscosity(State const& state) const;
    //! Only of a model that transports turbulence. Collective.
    Eddies eddies(State const& state) const;

    //! Temperature that the implicit heat term of the last step was taken at, K: the gas received
    //! heat_value - heat_coefficient (T - 273.15). Differs from State::temperature by what convection of second order
    //! moved.
    Field const& exchanged_temperature() const;

    //! Momentum of the gas on all faces of all ranks, kg m/s, with the mass of the middle of the last step that this
    //! solver took (none: of now): what the forces of all steps of equal length add up to. Collective.
    Vec3 momentum(State const& state) const;

    //! Flow and state of what enters may change from step to step.
    Inlet& inlet(std::size_t number);

    FaceWeights const& weights() const;
    Settings const& settings() const;

    //! @{ What the next step depends on beside the state: the first guess of the pressure's correction (by cell), and
    //! what the pressure solver remembers. Without the latter, or on other ranks, the next step agrees to the solver's
    //! tolerance.
    Field const& correction() const;
    solve::Pressure::Memory const& pressure_memory() const;
    void recall(Field correction, std::optional<solve::Pressure::Memory> memory);
    //! @}

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};
}
