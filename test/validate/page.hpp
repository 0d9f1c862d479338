// The page of validation: one section for each bed, with a table of our numbers against the published range and a
// picture.
//
// Tests hand in sections; when the program ends they replace those of the same name in the page named by
// GRANUM_VALIDATE_PAGE (or beds.md where the program runs) and leave the others, so that one bed can be run again
// alone.
#pragma once

#include "granum/report/picture.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <source_location>
#include <sstream>
#include <string>
#include <vector>

namespace granum::validate
{
class Page : public ::testing::Environment
{
  public:
    static Page& only()
    {
        static Page* const page = new Page;  // gtest deletes its environments
        return *page;
    }

    //! The file to write.
    static std::filesystem::path file()
    {
        char const* const named = std::getenv("GRANUM_VALIDATE_PAGE");
        return named ? named : "beds.md";
    }

    void section(std::string const& heading, std::string const& text) { sections_[heading] = text; }

    void TearDown() override
    {
        std::map<std::string, std::string> all;
        std::ifstream in(file());
        std::string heading;
        for (std::string line; std::getline(in, line);) {
            if (line.starts_with("## "))
                heading = line.substr(3);
            else if (!heading.empty())
                all[heading] += line + "\n";
        }
        for (auto const& [name, text] : sections_) all[name] = "\n" + text + "\n";
        std::ofstream out(file());
        out << "# Beds\n\nWritten by `./dev test validate`; do not edit. Beds of some thousand spheres against "
               "published ranges.\n[R]: recalled from the literature, not read again. Young's modulus is lowered, as "
               "usual, so that steps are few.\nTimes are those of one core of a busy machine.\n";
        for (auto const& [name, text] : all) {
            auto const last = text.find_last_not_of('\n');
            out << "\n## " << name << "\n" << text.substr(0, last + 1) << "\n";
        }
    }

  private:
    std::map<std::string, std::string> sections_;
};

inline ::testing::Environment* const registered = ::testing::AddGlobalTestEnvironment(&Page::only());

//! What stands in one section while its test runs.
class Section
{
  public:
    Section(std::string heading, std::string const& setup) : heading_(std::move(heading)), start_(std::clock())
    {
        text_ = setup + "\n\n| quantity | published | source | ours | verdict |\n|---|---:|---|---:|---|\n";
    }
    ~Section()
    {
        double const seconds = static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
        Page::only().section(heading_, text_ + fmt::format("\nTook {:.0f} s.", seconds) + pictures_);
    }
    Section(Section const&) = delete;
    Section& operator=(Section const&) = delete;

    //! A number that has to lie from `low` to `high`.
    void between(std::string const& quantity, double low, double high, std::string const& source, double ours,
                 std::source_location const& where = std::source_location::current())
    {
        row(quantity, fmt::format("{:.4g} to {:.4g}", low, high), source, fmt::format("{:.4g}", ours),
            ours >= low && ours <= high, where);
    }

    //! Two of ours that have to enclose the published number, to within `tolerance`.
    void encloses(std::string const& quantity, double published, double tolerance, std::string const& source,
                  double low, double high, std::source_location const& where = std::source_location::current())
    {
        row(quantity, fmt::format("{:.4g} +- {:.4g}", published, tolerance), source,
            fmt::format("{:.4g} and {:.4g}", low, high), low - tolerance <= published && published <= high + tolerance,
            where);
    }

    //! Numbers that have to rise.
    void rising(std::string const& quantity, std::string const& source, std::vector<double> const& ours,
                std::source_location const& where = std::source_location::current())
    {
        bool good = true;
        std::string shown;
        for (std::size_t k = 0; k < ours.size(); ++k) {
            shown += fmt::format("{}{:.4g}", k > 0 ? ", " : "", ours[k]);
            good = good && (k == 0 || ours[k] > ours[k - 1]);
        }
        row(quantity, "rises", source, shown, good, where);
    }

    //! A number without a published one.
    void tells(std::string const& quantity, double ours)
    {
        text_ += fmt::format("| {} | | | {:.4g} | |\n", quantity, ours);
    }

    //! Draws spheres coloured by `values`, cut at `snapshot.mid_plane`, into `name`.png beside the page.
    void picture(std::string const& name, io::Snapshot const& snapshot, std::vector<double> const& values,
                 report::ValueRange const& range, std::string const& caption)
    {
        auto const window = report::window_of(snapshot);
        double const widest = 700 * (window.z1 - window.z0) / (window.x1 - window.x0);
        report::Picture drawn(window, static_cast<int>(std::min(260.0, widest)));
        drawn.draw_granules(snapshot, values, range, report::viridis);
        drawn.draw_outline(snapshot);
        auto const bytes = drawn.png();
        auto const path = Page::file().parent_path() / (name + ".png");
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<char const*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        pictures_ += fmt::format("\n\n![{}]({}.png)\n\n{}", caption, name, caption);
    }

  private:
    void row(std::string const& quantity, std::string const& published, std::string const& source,
             std::string const& ours, bool good, std::source_location const& where)
    {
        text_ +=
            fmt::format("| {} | {} | {} | {} | {} |\n", quantity, published, source, ours, good ? "holds" : "FAILS");
        if (!good)
            ADD_FAILURE_AT(where.file_name(), static_cast<int>(where.line()))
                << heading_ << ", " << quantity << ": " << ours << ", published " << published;
    }

    std::string heading_, text_, pictures_;
    std::clock_t start_;
};
}
