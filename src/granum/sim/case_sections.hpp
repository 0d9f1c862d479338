// The sections of a case, each read into its struct; the pieces that case_reader puts together.
#pragma once

#include "granum/io/case_file.hpp"
#include "granum/sim/case.hpp"
#include "granum/sim/case_reader.hpp"

namespace granum::sim
{
void read_apparatus(io::CaseFile& file, Case& data, Purpose purpose);
//! The chamber of [[apparatus.solid]]. Where it is no chamber, Chamber::known() is false.
void read_solids(io::CaseFile& file, Case& data);
void read_internals(io::CaseFile& file, Case& data);  //!< [[internal]], after the apparatus and the materials
void read_contact(io::CaseFile& file, Case& data);    //!< with the materials
void read_granules(io::CaseFile& file, Case& data, Purpose purpose);  //!< after the materials
void read_walls(io::CaseFile& file, Case& data);                      //!< after the materials
void read_region(io::CaseFile& file, Case& data);                     //!< after the apparatus
void read_feeds(io::CaseFile& file, Case& data);                      //!< after the granules
void read_gas(io::CaseFile& file, Case& data, Purpose purpose);
void read_turbulence(io::CaseFile& file, GasCase& gas);  //!< and the law of the viscosity, of [gas]
//! A mistake at `key` where the model of turbulence transports no k.
void need_eddies(io::CaseFile& file, std::string const& key, GasCase const& gas);
void read_openings(io::CaseFile& file, Case& data);   //!< [[inlet]], [[outlet]], after [gas]
void read_gas_walls(io::CaseFile& file, Case& data);  //!< [[gas.wall]], after the apparatus
//! Flow, temperature and humidity of a gas, at the keys that begin with `key` ("gas.").
FlowCase read_flow(io::CaseFile& file, std::string const& key, GasCase const& gas, double temperature);
//! left, right, front, back, bottom, top.
std::vector<std::string> const& end_names();
void read_cells(io::CaseFile& file, Case& data);  //!< after the apparatus and the granules
void read_spray(io::CaseFile& file, Case& data, Purpose purpose);
void read_process(io::CaseFile& file, Case& data);                //!< [drying] [product] [start]
void read_time(io::CaseFile& file, Case& data, Purpose purpose);  //!< and the intervals of [output]
void read_output(io::CaseFile& file, Case& data);                 //!< after the apparatus
void read_phases(io::CaseFile& file, Case& data);                 //!< after gas and spray

//! The box between `key`lower and `key`upper, within the apparatus.
RegionCase read_box(io::CaseFile& file, std::string const& key, geometry::Chamber const& chamber,
                    std::string const& doc);
//! A name that heads columns of a CSV file must not break them.
void check_column_name(io::CaseFile& file, std::string const& key, std::string const& name);

//! Openings that the solids of the apparatus or bodies in it cover; after the openings.
void check_against_bodies(io::CaseFile& file, Case const& data);
//! Which wall a place that is not open lies in, to be read after "is".
std::string where_in_bodies(geometry::Chamber const& chamber, Vec3 const& x);
void check_hard_spheres(io::CaseFile& file, Case const& data);  //!< after all others

//! What no single value shows: the mistakes and warnings that follow from values together.
void cross_check(io::CaseFile& file, Case const& data, Purpose purpose, std::vector<std::string>& warnings);

//! @{ Names of the materials of a case, and the number of one (that of their count if there is none).
std::vector<std::string> material_names(ContactCase const& contact);
std::uint32_t material_number(ContactCase const& contact, std::string const& name);
//! @}

//! The number of the material that `key` names; `fallback` where it names none.
std::uint32_t read_material(io::CaseFile& file, ContactCase const& contact, std::string const& key,
                            std::uint32_t fallback, std::string const& doc);

//! The size distribution at `prefix` + "size", or nothing where it is not given or wrong.
std::optional<particle::SizeDistribution> read_sizes(io::CaseFile& file, std::string const& prefix);

//! Lets the sections take missing values from the material named by `key`; a wrong name is a mistake there. Returns the
//! name, empty where none is given.
std::string take_material(io::CaseFile& file, std::string const& key, std::vector<std::string> const& sections);
}
