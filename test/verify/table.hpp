// The table of verification: each row holds a number of ours against one from elsewhere. A row outside its tolerance
// fails its test. When a whole program has run, its rows are written to the folder named by GRANUM_VERIFY_ROWS, from
// which tools/verify_table.py makes the page of the manual.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <source_location>
#include <string>
#include <vector>

namespace granum::verify
{
using Where = std::source_location;

struct Row
{
    std::string id, published, quantity, reference, ours, difference, tolerance;
    bool good;
    std::string verdict{};  //!< instead of whether it holds
};

//! The id of a row and, where it is known, how far off published codes are in it.
struct Case
{
    Case(char const* name, std::string others = "") : id(name), published(std::move(others)) {}

    std::string id, published;
};

class Table : public ::testing::Environment
{
  public:
    static Table& only()
    {
        static Table* const table = new Table;  // gtest deletes its environments
        return *table;
    }

    void add(Row row, Where const& where)
    {
        if (!row.good)
            ADD_FAILURE_AT(where.file_name(), static_cast<int>(where.line()))
                << row.id << ", " << row.quantity << ": " << row.ours << " instead of " << row.reference
                << ", difference " << row.difference << ", tolerance " << row.tolerance;
        rows_.push_back(std::move(row));
    }

    void differs(Row row) { rows_.push_back(std::move(row)); }

    void TearDown() override
    {
        if (GTEST_FLAG_GET(filter) != "*") return;  // part of the rows is no table
        char const* const folder = std::getenv("GRANUM_VERIFY_ROWS");
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        if (!folder || rank > 0) return;
        std::ofstream out(std::string(folder) + "/" + GRANUM_TEST_NAME + ".tsv");
        for (auto const& row : rows_)
            out << fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", row.id, row.quantity, row.reference, row.ours,
                               row.difference, row.tolerance, row.published,
                               !row.verdict.empty() ? row.verdict
                               : row.good           ? "holds"
                                                    : "FAILS");
    }

  private:
    std::vector<Row> rows_;
};

inline ::testing::Environment* const registered = ::testing::AddGlobalTestEnvironment(&Table::only());

//! `ours` within the share `tolerance` of `reference`.
inline void relative(Case const& source, std::string const& quantity, double reference, double ours, double tolerance,
                     Where const& where = Where::current())
{
    double const difference = ours / reference - 1;
    Table::only().add({source.id, source.published, quantity, fmt::format("{:.6g}", reference),
                       fmt::format("{:.6g}", ours), fmt::format("{:+.2g} %", 100 * difference),
                       fmt::format("{:.2g} %", 100 * tolerance), std::abs(difference) <= tolerance},
                      where);
}

//! `ours` within `tolerance`, in the quantity's unit, of `reference`.
inline void absolute(Case const& source, std::string const& quantity, double reference, double ours, double tolerance,
                     Where const& where = Where::current())
{
    double const difference = ours - reference;
    Table::only().add(
        {source.id, source.published, quantity, fmt::format("{:.6g}", reference), fmt::format("{:.6g}", ours),
         fmt::format("{:+.2g}", difference), fmt::format("{:.2g}", tolerance), std::abs(difference) <= tolerance},
        where);
}

//! `ours` from `low` to `high`.
inline void between(Case const& source, std::string const& quantity, double low, double high, double ours,
                    Where const& where = Where::current())
{
    Table::only().add({source.id, source.published, quantity, fmt::format("{:.6g} to {:.6g}", low, high),
                       fmt::format("{:.6g}", ours), "", "range", ours >= low && ours <= high},
                      where);
}

//! `ours` not above `limit`; what is asked for is 0.
inline void below(Case const& source, std::string const& quantity, double limit, double ours,
                  Where const& where = Where::current())
{
    Table::only().add({source.id, source.published, quantity, "0", fmt::format("{:.2g}", ours),
                       fmt::format("{:.2g}", ours), fmt::format("{:.2g}", limit), std::abs(ours) <= limit},
                      where);
}

//! A reference that rests on other assumptions than ours, and the mean difference from it: shown, and held below
//! `limit` so that a change is seen.
inline void differs(Case const& source, std::string const& quantity, double limit, double ours, std::string const& why,
                    Where const& where = Where::current())
{
    if (ours > limit)
        ADD_FAILURE_AT(where.file_name(), static_cast<int>(where.line()))
            << source.id << ", " << quantity << ": " << ours << " was below " << limit;
    Table::only().differs({source.id, source.published, quantity, "0", fmt::format("{:.2g}", ours),
                           fmt::format("{:.2g}", ours), "", true, "differs: " + why});
}
}
