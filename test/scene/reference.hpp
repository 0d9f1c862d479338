// Reads the reference cases of test/reference: the table of a CSV file and the parameters of a TOML file.
#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace granum::scene
{
//! Columns by name, rows of text as written; lines that start with # are skipped, quoted cells may hold commas.
class Table
{
  public:
    //! `file` within test/reference. Throws std::runtime_error where it cannot be read or has no rows.
    explicit Table(std::string const& file)
    {
        std::ifstream in(GRANUM_SOURCE_DIR "/test/reference/" + file);
        for (std::string line; std::getline(in, line);) {
            if (line.empty() || line.front() == '#') continue;
            if (header_.empty())
                header_ = cells(line);
            else
                rows_.push_back(cells(line));
        }
        if (rows_.empty()) throw std::runtime_error("no rows in test/reference/" + file);
    }

    std::size_t rows() const { return rows_.size(); }
    bool has(std::size_t row, std::string const& column) const { return !text(row, column).empty(); }
    std::string const& text(std::size_t row, std::string const& column) const
    {
        for (std::size_t i = 0; i < header_.size(); ++i)
            if (header_[i] == column) return rows_.at(row).at(i);
        throw std::runtime_error("no column " + column);
    }
    double number(std::size_t row, std::string const& column) const { return std::stod(text(row, column)); }

  private:
    static std::vector<std::string> cells(std::string const& line)
    {
        std::vector<std::string> out(1);
        bool quoted = false;
        for (char const c : line) {
            if (c == '"')
                quoted = !quoted;
            else if (c == ',' && !quoted)
                out.emplace_back();
            else if (c != '\r')
                out.back() += c;
        }
        return out;
    }

    std::vector<std::string> header_;
    std::vector<std::vector<std::string>> rows_;
};

//! The number in `text` after `name` and "=": "T=30, W=0.02" and "W" give 0.02.
inline double number_after(std::string const& text, std::string const& name)
{
    std::string const spaced = " " + text;
    auto const at = spaced.find(" " + name + "=");
    if (at == std::string::npos) throw std::runtime_error("no " + name + " in " + text);
    return std::stod(spaced.substr(at + name.size() + 2));
}
}
