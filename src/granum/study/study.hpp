// A campaign: operating points that are one case with some values set anew, each run until its statistics are good
// enough.
//
// The file names points; the folder of the study keeps a case and a run for each, so that a campaign that was
// interrupted goes on where it was. Whoever starts it says how a case is run (study::Runner), so that ranks and signals
// stay the program's business.
#pragma once

#include "granum/map/run_deposits.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace granum::study
{
//! How well the steady part of a run must be known.
struct Goal
{
    double least = 5, most = 30;  //!< s of the window: at least so long, then no longer than this
    double error = 0.01;          //!< standard error of the mean of log10 of the drying time to be reached
};

struct Point
{
    std::string name;
    std::string base;  //!< path of the case it is made of
    std::string key;   //!< table of the study with what it sets: "point[2].set"
    Goal goal;
};

struct Study
{
    std::string path, title;
    std::vector<Point> points;
    Goal goal;              //!< of points that have none of their own
    std::string map;        //!< path of a map to predict with; empty: none
    std::string reference;  //!< name of the point that the others are compared with; empty: none
};

//! Throws base::CaseError with every mistake of the file. The cases of its points are checked too.
Study read_study(std::string const& path);

//! The text of a point's case.
std::string case_of(Study const& study, Point const& point);

//! Runs a case in a folder, or goes on with it, until a simulated time; returns the exit status of `granum run`.
using Runner = std::function<int(std::string const& case_file, std::string const& folder, double until)>;

//! What a point came to.
struct Outcome
{
    Point point;
    std::string folder;
    map::RunDeposits deposits;
    bool enough = false;             //!< the window is long enough and the error small enough
    double simulated = 0, wall = 0;  //!< s
    double eta = 0, outlet_temperature = 0, outlet_humidity = 0;  //!< of the run: 1, K, kg/kg
    double balance_eta = 0, balance_temperature = 0, balance_humidity = 0;
    double solids_error = 0, water_error = 0;  //!< of the ledgers
};

//! Writes the cases of all points into `folder` and checks them: what is wrong with the last must not wait for the runs
//! before it. Their files, in the order of the points. Throws base::CaseError.
std::vector<std::string> write_cases(Study const& study, std::string const& folder);

struct Campaign
{
    std::vector<Outcome> outcomes;  //!< of the points that are done, in their order
    bool stopped = false;           //!< a run was asked to stop
};

//! Runs the points in `folder`, in their order; those that another process is at are left to it. A point that stops
//! (status 130) ends the campaign with what is there. `said` receives a line now and then. Throws base::Error where a
//! run fails.
Campaign run(Study const& study, std::string const& folder, Runner const& runner,
             std::function<void(std::string const&)> const& said);

//! Until which simulated time a run is to go on, given its window; empty: it need not.
std::optional<double> next_end(Goal const& goal, map::Window const& window);

//! study.csv and study.html in `folder`.
void write(Study const& study, std::vector<Outcome> const& outcomes, std::string const& folder);
}
