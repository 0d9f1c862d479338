// A case, resolved: what `granum run` needs, in SI units, with every default filled in. Built from TOML by case_reader.
#pragma once

#include "granum/geometry/body.hpp"
#include "granum/geometry/chamber.hpp"
#include "granum/law/deposit/crystallisation.hpp"
#include "granum/law/impact/splash.hpp"
#include "granum/law/layer/abrasion.hpp"
#include "granum/law/vapour/sorption.hpp"
#include "granum/math/constants.hpp"
#include "granum/particle/sizes.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace granum::sim
{
using math::Vec3;

//! A material that touches. Number 0 is "granule" and 1 is "wall", then follow those of [material.NAME].
struct MaterialCase
{
    std::string name;
    double density = 0;           //!< kg/m3 of granules; 0: not given
    double youngs_modulus = 1e7;  //!< Pa, usually softened
    double poisson_ratio = 0.25;
    bool rigid = false;              //!< does not yield: only the partner's modulus counts
    double heat_conductivity = 0;    //!< W/m/K; 0: passes no heat to what it touches
    double real_youngs_modulus = 0;  //!< Pa; 0: not given
};
struct ContactPair
{
    double restitution = 0.8;
    double sliding_friction = 0.3;
    double rolling_friction = 0.01;
    double rolling_damping = 0.3;  //!< of `epsd-dashpot`
    double stiffness = 1000;       //!< of `linear`, N/m
};

//! [contact]
struct ContactCase
{
    std::vector<MaterialCase> materials{{.name = "granule"}, {.name = "wall"}};
    std::vector<std::vector<ContactPair>> pairs{{{}}, {{}, {}}};  //!< [a][b], b up to a: how two materials meet
    std::string engine = "soft";                                  //!< or "hard": contacts are instants
    std::string normal = "hertz-tsuji";                           //!< law names
    std::string tangential = "mindlin";
    std::string rolling = "epsd";
    std::string conduction = "none";
    std::string film = "none";       //!< heat through the gas between surfaces that touch or nearly do
    double film_lens = 0.2;          //!< thickness of that gas over the radius of the larger granule
    double film_shortest = 27.5e-9;  //!< way through it that is never undercut, m
    bool collisions = false;         //!< contacts are collisions: heat passes for as long as real ones last
    //! s; of `linear`, in place of stiffnesses: of two of the smallest granules; of hard spheres: a collision sooner
    //! than this after another of the same granule is elastic.
    std::optional<double> contact_time;
    double tangential_restitution = 0.33;  //!< of hard spheres: of the slip where surfaces stick
    double tangential_ratio = 2.0 / 7;     //!< of `linear`: tangential over normal stiffness
    double reference_speed = 1;            //!< of `hertz-viscoelastic`: where the restitution is that given, m/s
    bool lever_radius = false;             //!< lever arm R instead of R - overlap/2
    bool keep_attraction = false;          //!< keep the tensile end of a damped contact (Tsuji's own damping)

    bool hard() const { return engine == "hard"; }
    bool conducts() const { return conduction != "none"; }
    bool films() const { return film != "none"; }
};

//! One granule with its place: from [[granule]] tables, a CSV file or another run.
struct GranuleCase
{
    Vec3 position, velocity, spin;
    double diameter = 0;  //!< of a real granule, m
    double density = 0;   //!< kg/m3; 0: that of its material
    double count = 1;     //!< real granules in the parcel
    std::uint64_t id = 0;
    std::uint32_t material = 0;
    double temperature = 0;  //!< K at the start; 0: that of the bed
};

//! A box in which granules appear.
struct RegionCase
{
    Vec3 lower, upper;  //!< m
};

//! [[granules.batch]]: granules of one material and one size distribution.
struct BatchCase
{
    std::string name;
    std::uint32_t material = 0;
    double density = 0;  //!< kg/m3
    particle::SizeDistribution sizes = particle::SizeDistribution::single(0.6e-3);
    double mass = 0;          //!< kg
    double parcel_ratio = 1;  //!< l: a parcel stands for l^3 granules
    long parcels = 0;
};

//! [granules]
struct GranulesCase
{
    double diameter = 0.6e-3;       //!< m, of a real granule
    double density = 1445;          //!< kg/m3
    double mass = 0;                //!< kg of the batch; 0 where granules are given one by one
    double parcel_ratio = 1;        //!< l: a parcel stands for l^3 granules
    double heat_capacity = 1400;    //!< J/kg/K of the dry core and layer
    double emissivity = 0;          //!< of the surface; 0: no radiation
    double pores = 0;               //!< share of a core that liquid can enter; 0: none
    double pore_radius = 0;         //!< m, effective
    std::string start = "settled";  //!< "settled" (random packing that fell under gravity), "loose", "lattice", "given"
    double spacing = 1.1;           //!< of a lattice, diameters
    double noise = 0;               //!< of a lattice, share of the free way
    double agitation = 0;  //!< root mean square of each velocity component of granules placed by the program, m/s
    std::optional<RegionCase> region;
    std::vector<BatchCase> batches;  //!< empty where granules are given one by one
    std::vector<GranuleCase> given;
    bool frozen = false;           //!< granules do not move (fixed bed)
    long parcels = 0;              //!< derived
    std::uint64_t first_free = 0;  //!< derived: identities are below this
};

//! [[feed]]: the granules of a batch appear in a region while the run goes on.
struct FeedCase
{
    std::size_t batch = 0;
    RegionCase region;
    double rate = 0;                                        //!< kg/s; 0: as fast as there is room
    double start = 0;                                       //!< s
    double stop = std::numeric_limits<double>::infinity();  //!< s
    Vec3 velocity;                                          //!< m/s
    double interval = 0.01;                                 //!< between portions, s
};

//! A gas flow.
struct FlowCase
{
    double dry_mass_flow = 0;     //!< kg dry air per s; 0 where `velocity` is given
    double velocity = 0;          //!< superficial where it enters, m/s; < 0: not given
    double temperature = 293.15;  //!< K
    double humidity = 0;          //!< kg water per kg dry air
};

//! A hole of a plate.
struct HoleCase
{
    double x, y;    //!< of its centre along the two directions of the plate, m
    double radius;  //!< m
};

//! A part of an end of the domain: [[inlet]] or [[outlet]].
struct OpeningCase
{
    std::string name;
    std::size_t direction = 2;  //!< of the end
    bool upper = false;
    std::optional<RegionCase> rectangle;       //!< only what lies within
    bool round = false;                        //!< only a disc or ring
    Vec3 centre{};                             //!< of it, m
    double outer = 0, inner = 0;               //!< radii, m
    bool parabolic = false;                    //!< laminar profile of velocity; else even, or by rings or holes
    std::vector<std::array<double, 2>> rings;  //!< outer radius (m), relative mass flow per area
    std::vector<HoleCase> holes;
};

//! [[inlet]]
struct InletCase : FlowCase
{
    OpeningCase at;
    double tracer = 0;  //!< kg/kg moist gas
    double turbulence_intensity = 0.05;
    std::optional<double> turbulence_length;  //!< m
};

//! [[outlet]]
struct OutletCase
{
    OpeningCase at;
    double pressure = 0;                        //!< above gas.pressure, Pa
    double resistance = 30;                     //!< Pa s/m
    double temperature = 293.15, humidity = 0;  //!< of what is drawn in
};

//! [[gas.wall]]
struct GasWallCase
{
    std::string of = "all";  //!< an end of a box, "chamber", or "all"
    bool slip = false;
    Vec3 velocity;                      //!< m/s
    std::optional<double> temperature;  //!< K
    double loss = 0;                    //!< W/m2/K
    double outside = 293.15;            //!< K
};

//! [[gas.fine]]: cells of their own size between two planes.
struct FineCase
{
    std::size_t axis = 2;
    double lower = 0, upper = 0, size = 0;  //!< m
    double growth = 1.2;                    //!< ratio of neighbours beyond
};

//! [gas.tracer]
struct TracerCase
{
    double diffusivity = 2e-5;  //!< m2/s
    std::optional<double> molar_mass;
};

//! [gas]
//! What acts between granules and gas beside drag and transfer, in [gas].
struct ForceCase
{
    std::string virtual_mass = "none", shear_lift = "none", spin_lift = "none", torque = "none";
    int history = 0;            //!< steps of the window of Basset's force; 0: off
    bool polydisperse = false;  //!< drag of each size of a mixture
    bool filtered = false;      //!< drag of cells wider than clusters
};
//! Turbulence of the gas and the viscosity's law, in [gas].
struct TurbulenceCase
{
    std::string model = "laminar";
    std::map<std::string, double> constants;  //!< of the model and of the law of the wall
    double intensity = 0.05;                  //!< of what enters
    std::optional<double> velocity, length;   //!< at the start: m/s, m; the length also of what enters
    double prandtl = 0.85, schmidt = 0.85;
    double dense = 0.7, free = 0.95;  //!< voidages between which granules let eddies grow
    bool granules = false;            //!< whether they damp and make turbulence
    double wake = 0, memory = 0.3, rate = 1.5;
};
struct ViscosityCase
{
    std::string law = "newtonian";
    double infinite = 0, time = 0, exponent = 1;  //!< Pa s, s, 1
};
struct GasCase
{
    bool present = false;
    //! All inlets together: their flow, mixed temperature and humidity; of a plate, its velocity.
    FlowCase inlet;
    std::vector<InletCase> inlets;
    std::vector<OutletCase> outlets;
    std::vector<GasWallCase> walls;
    std::string model = "A";
    std::string compressibility = "low-mach";                             //!< "constant", "low-mach" or "full"
    std::string convection = "second-order";                              //!< or "upwind"
    double pressure = math::standard_pressure;                            //!< Pa at the outlet
    std::optional<double> density, viscosity, conductivity, diffusivity;  //!< constant values instead of moist air
    std::optional<double> molar_mass, vapour_molar_mass;                  //!< kg/mol, instead of air and water
    double expansion = 0, expansion_temperature = 293.15;                 //!< of a constant density: 1/K, K
    Vec3 push;                                                            //!< N/m3
    std::optional<TracerCase> tracer;
    std::array<int, 3> cells{1, 1, 1};
    std::array<std::vector<double>, 3> faces;  //!< of the cells, m
    std::vector<FineCase> fine;
    std::string drag = "beetstra";
    std::string heat_transfer = "gunn";
    ForceCase forces;
    TurbulenceCase turbulence;
    ViscosityCase thinning;
    std::string dispersion = "none";  //!< of what granules see of the turbulence
    std::string mapping = "kernel";   //!< or "centre" or "divided"
    std::optional<double> smoothing;  //!< bandwidth of the smoothing of what granules and gas share, m; none: by size
    bool closed = false;              //!< no inlet and no outlet (periodic or closed box)
    double tolerance = 1e-6;          //!< of the pressure's equation
    std::string pressure_solver = "multigrid";
    long rebalance_every = 0;  //!< gas steps after which ranks share space anew; 0: where their work is uneven
    Vec3 initial_velocity;     //!< m/s
};

//! [spray]: one liquid, any number of nozzles share its rate equally.
struct NozzleCase
{
    Vec3 position;                    //!< m
    Vec3 direction{0, 0, -1};         //!< unit
    double half_angle = 0.26;         //!< rad, of the droplet cone
    double air_mass_flow = 0;         //!< kg/s of atomising air, dry
    double air_temperature = 293.15;  //!< K
    double air_humidity = 0;          //!< kg/kg dry
    double air_velocity = 250;        //!< m/s at the exit: momentum = mass flow * velocity
    double air_pressure = 0;          //!< Pa, absolute, before the mouth; 0: not told
    double air_mouth = 0;             //!< m2, with air_pressure
    double bore = 0;                  //!< m, diameter of the liquid's mouth; 0: not told
    double droplet_median = 0;        //!< m, of its own droplets; 0: that of the spray
    double droplet_velocity = 30;     //!< m/s at the exit
};
struct SprayCase
{
    bool present = false;
    std::string liquid = "sodium-benzoate-30";
    double rate = 0;                                                   //!< kg of liquid per s, all nozzles
    double solids_fraction = 0.3;                                      //!< kg solids per kg liquid
    double temperature = 298.15;                                       //!< K
    double density = 1130, viscosity = 3e-3, surface_tension = 0.063;  //!< SI
    double solids_density = 1440;                                      //!< kg/m3 of the dry solids without pores
    double solubility = 0.63;       //!< kg solids per kg water at saturation; 0: a suspension (water activity 1)
    double molar_mass = 0.1441;     //!< kg/mol of the solute
    double dissociation = 2;        //!< van 't Hoff factor
    double contact_angle = 0.698;   //!< rad
    double droplet_median = 40e-6;  //!< m, of the volume distribution
    double droplet_spread = 1.6;    //!< geometric standard deviation
    std::optional<particle::SizeDistribution> size;  //!< instead of median and spread
    double locking = 0;                              //!< share of the volume at which solids lock; 0: they never do
    double solids_diffusivity = 0, crust_diffusivity = 0;  //!< m2/s
    double melting_point = 0;                              //!< K, of a melt; 0: no melt
    double fusion_heat = 0;                                //!< J/kg
    double conductivity = 0;                               //!< of melt and granule, W/m/K
    law::impact::Splash splash;
    std::string atomisation = "none";  //!< law that gives each nozzle's median instead
    double parcels_per_second = 2e4;
    std::vector<NozzleCase> nozzles;
    std::string capture = "loeffler";  //!< law of capture by granules
    std::optional<double> reach;      //!< m, within which a droplet strikes granules; else three of the largest parcels
    std::string dispersion = "none";  //!< of what droplets see of the turbulence
    bool allow_overwetting = false;
};

//! [drying]
struct DryingCase
{
    std::string deposit = "combined";  //!< "cap", "boundary-layer" or "combined"
    std::string stages = "falling-rate";
    std::string solidification = "gas-and-granule";
    std::string sorption = "none";  //!< of the cores
    law::vapour::Gab gab;
    double sorption_time = 300;      //!< s
    std::optional<double> absorbed;  //!< kg/kg core at the start; otherwise in equilibrium
    double roughness = 1e-6;         //!< m, of granules
    std::string abrasion = "none";   //!< of layers
    law::layer::CollisionEnergy collision_energy;
    double abrasion_threshold = 0;  //!< J per kg of granule and collision
    std::string crystallisation = "at-saturation";
    law::deposit::NucleationGrowth crystals;
    double critical_moisture = 0;  //!< X_cr, kg/kg solids: falling rate below; 0: none
    double falling_exponent = 1;
    std::array<double, 3> rea{0.998, 1.405, 0.930};  //!< a, b, c of the reaction engineering approach
    double equilibrium_moisture = 0;                 //!< X_eq, kg/kg solids, that stays
    double film_coverage = 0.9;                      //!< above it deposits dry as one film
    bool merge = true;                               //!< droplets that fall on a wet deposit join it
    double end_moisture = 0.01;  //!< fraction of the feed's moisture at which a deposit counts as dry
};

//! [product]
struct ProductCase
{
    std::string porosity_model = "linear-drying-potential";
    double porosity_at_zero = 0.70;  //!< layer porosity at eta = 0
    double porosity_slope = -0.50;   //!< d porosity / d eta
    double porosity_band = 0.07;     //!< one standard deviation of a layer element about the line
    bool illustrative = true;        //!< coefficients not fitted to measurements of this product
};

//! [start]
struct StartCase
{
    bool quasi_steady = true;                                //!< bed, gas and surface moisture from the balance
    double temperature_offset = 0;                           //!< K added to the bed temperature of the balance
    std::optional<double> bed_temperature, gas_temperature;  //!< K, where not from the balance
    //! s at most, in which the mean temperature of the bed follows the gas as if the bed had next to no heat capacity.
    double settling = 0;
};

//! [time] and [output]
struct TimeCase
{
    double duration = 1;
    std::optional<double> granule_step, gas_step;  //!< s; otherwise chosen from the bounds
    double output_interval = 0.1;                  //!< of pictures and ParaView files, s
    double series_interval = 0.005;                //!< of timeseries.csv, s
    double checkpoint_interval = 600;              //!< of wall time, s; the first comes after two minutes at the latest
    std::optional<double> checkpoint_every;        //!< s of process, beside the wall time
};

//! [[output.box]]: a box in which the share of solids is measured.
struct BoxCase
{
    std::string name;
    RegionCase region;
};

//! A point where the gas is looked at, or points along a line at equal distances, both ends among them.
struct ProbeCase
{
    std::string name;
    Vec3 from, to;
    long points = 1;

    Vec3 at(long k) const
    {
        return points < 2 ? from : from + static_cast<double>(k) / static_cast<double>(points - 1) * (to - from);
    }
    //! Of the columns of a point: the name, and its number on a line.
    std::string label(long k) const { return points < 2 ? name : name + "-" + std::to_string(k); }
};

//! What [output] asks for besides its intervals.
struct OutputCase
{
    long surfaces = 200;               //!< real granules whose surfaces are laid cap by cap
    double overlap_criterion = 0.003;  //!< share of a radius: contacts beyond it are counted [R]
    std::vector<BoxCase> boxes;
    std::vector<ProbeCase> probes;
};

//! [[phase]]: what is set from `start` on; what a phase does not name stays as it was
struct PhaseCase
{
    std::string name;
    double start = 0, end = 0;                            //!< s
    bool ramp = false;                                    //!< reached at the end, in a straight line; else at once
    std::optional<double> gas_temperature, gas_humidity;  //!< K, kg/kg
    std::optional<double> gas_share;                      //!< of the flows that the case states
    std::optional<double> spray_rate;                     //!< kg/s
};

struct Case
{
    std::string title = "untitled";
    std::string file;  //!< as the user typed it
    geometry::Chamber chamber;
    std::array<bool, 3> periodic{};             //!< of a box
    std::array<std::array<bool, 2>, 3> open{};  //!< [axis][low, high]: faces without a wall
    bool discharge = false;                     //!< granules that leave through open faces are counted, not an error
    std::vector<geometry::Body> bodies;         //!< walls of [[apparatus.solid]] and [[internal]]
    double resolution = 0;                      //!< to which walls of joined bodies are drawn, m
    std::vector<geometry::Body> walls;          //!< [[wall]], besides those of the chamber
    Vec3 gravity{0, 0, -math::standard_gravity};
    std::uint32_t seed = 1;
    ContactCase contact;
    GranulesCase granules;
    std::vector<FeedCase> feeds;
    GasCase gas;
    SprayCase spray;
    DryingCase drying;
    ProductCase product;
    StartCase start;
    TimeCase time;
    OutputCase output;
    std::vector<PhaseCase> phases;  //!< one after the other, from 0 on
};

//! Where a resolved value came from, for `granum explain` and the stored case.
struct Origin
{
    std::string key;     //!< dotted
    std::string value;   //!< with its unit, as resolved
    std::string origin;  //!< "line 12", "default" or "derived"
    std::string doc;     //!< one line
};

struct ResolvedCase
{
    Case data;
    std::vector<Origin> origins;
    std::vector<std::string> warnings;
};
}
