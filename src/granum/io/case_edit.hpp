// A case with some of its values set anew, as a file of its own: for campaigns and for the pilots of a lab case.
#pragma once

#include <memory>
#include <string>

namespace granum::io
{
class CaseEdit
{
  public:
    //! Throws base::CaseError where the file is missing or not TOML.
    explicit CaseEdit(std::string const& path);
    ~CaseEdit();
    CaseEdit(CaseEdit const&) = delete;
    CaseEdit& operator=(CaseEdit const&) = delete;

    bool has(std::string const& key) const;
    //! `value` as it is written in a case: "\"60 degC\"", "3", "[1, 2]". Keys are "gas.temperature", "nozzle[1].air";
    //! sections that are missing are made, entries of arrays are not. Throws base::CaseError naming the key where the
    //! value is not TOML or the place does not exist.
    void set(std::string const& key, std::string const& value);
    void remove(std::string const& key);
    //! Makes `count` tables of the array `name`, all like its first; needs one.
    void repeat(std::string const& name, int count);

    //! Sets all that stands in the table `key` of the file `path`, section by section; nothing where there is none. An
    //! array of tables replaces the one that was there.
    void merge(std::string const& path, std::string const& key);

    //! With `remark` as comment on top. Comments of the file that was read are gone.
    std::string text(std::string const& remark) const;

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};
}
