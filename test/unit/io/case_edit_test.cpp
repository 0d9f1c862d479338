// A case made of another says the same, its numbers as short as they were.
#include "granum/io/case_edit.hpp"

#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace
{
using namespace granum;

TEST(CaseEdit, writes_numbers_as_people_do)
{
    scene::TemporaryFolder const folder;
    std::ofstream(folder / "case.toml")
        << "title = \"it's 0.80000000000000004\"\n[contact]\nrestitution = 0.8\nslope = -1.5e-3\n"
           "whole = 1.0\ncount = 12\nlist = [0.1, 2]\nsize-e1 = \"0.6 mm\"\n";
    io::CaseEdit edit(folder / "case.toml");
    edit.set("contact.rolling", "0.30");
    auto const text = edit.text("made of the plant's 0.80000000000000004");
    for (auto const* line :
         {"# made of the plant's 0.80000000000000004\n", "it's 0.80000000000000004", "restitution = 0.8\n",
          "slope = -0.0015\n", "whole = 1.0\n", "count = 12\n", "[ 0.1, 2 ]", "rolling = 0.3\n"})
        EXPECT_NE(text.find(line), std::string::npos) << line << " is not in\n" << text;
}
}
