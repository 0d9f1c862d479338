# Writes the example cases that are templates into the program, so that `granum new` needs no files.
set(templates lab-gf3 01-lab-layering pilot-x8 11-pilot-x8 rectangular-bed 12-rectangular-bed pile 04-pile hopper 05-hopper drum 06-drum cooling-gas 07-cooling-gas wurster 08-wurster suspension 09-suspension melt 10-melt)
set(entries "")
while(templates)
    list(POP_FRONT templates name folder)
    set(path ${PROJECT_SOURCE_DIR}/examples/${folder}/case.toml)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
    file(READ ${path} text)
    string(APPEND entries "    Template{\"${name}\", R\"case(${text})case\"},\n")
endwhile()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/generated/templates.hpp @ONLY CONTENT
"// Written by templates.cmake from examples/.
#pragma once

#include <array>
#include <string_view>

namespace granum::app
{
struct Template
{
    std::string_view name, text;
};
inline constexpr std::array templates{
@entries@};
}
")
target_include_directories(granum PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/generated)
