#include "case_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mesogen::test {

CaseText::CaseText(double length, int across) : length_(length) {
  boundary("periodic_ghosts");
  section("particles", fmt::format("spacing = {:.17g}", length / across));
  kernel("quintic");
  section("time", "end = 1e6");
  precision("double");
}

CaseText& CaseText::section(const std::string& name, const std::string& lines) {
  const auto at =
      std::find_if(sections_.begin(), sections_.end(), [&](const auto& section) { return section.first == name; });
  if (at == sections_.end()) {
    sections_.emplace_back(name, lines);
  } else {
    at->second = lines;
  }
  return *this;
}

CaseText& CaseText::boundary(const std::string& type) {
  return section("domain", fmt::format("size = [{0:.17g}, {0:.17g}]\nboundary = \"{1}\"", length_, type));
}

CaseText& CaseText::kernel(const std::string& type, const std::string& laplacian) {
  return section("kernel", fmt::format("type = \"{}\"\nsmoothing_length = {:.17g}\nlaplacian = \"{}\"", type, 4.0 / 3.0,
                                       laplacian));
}

CaseText& CaseText::precision(const std::string& word) {
  return section("run", fmt::format("precision = \"{}\"", word));
}

CaseText& CaseText::flow(double viscosity, const std::string& more) {
  return section("physics.flow",
                 fmt::format("type = \"wcsph\"\ndensity = 1.0\nviscosity = {:.17g}\n{}", viscosity, more));
}

CaseText& CaseText::published_flow(double viscosity, const std::string& more) {
  std::string keys = fmt::format("type = \"wcsph_published\"\ndensity = 1.0\nviscosity = {:.17g}\n", viscosity);
  for (const auto& [key, value] :
       {std::pair("viscosity_form", "\"component\""), std::pair("density_filter", "0.0"),
        std::pair("shift_speed", "\"strain\""), std::pair("shift", "0.3"), std::pair("density_diffusion", "0.1")})
    if (more.find(std::string(key) + " =") == std::string::npos) keys += fmt::format("{} = {}\n", key, value);
  return section("physics.flow", keys + more);
}

CaseText& CaseText::nematic(double rotational_diffusivity, double flow_alignment, double elastic_constant) {
  return section("physics.nematic",
                 fmt::format("type = \"beris_edwards\"\nrotational_diffusivity = {:.17g}\nflow_alignment = {:.17g}\n"
                             "elastic_constant = {:.17g}\nbulk = {{ A = -1.0, C = 0.5 }}",
                             rotational_diffusivity, flow_alignment, elastic_constant));
}

CaseText& CaseText::active(double activity) {
  return section("physics.activity", fmt::format("type = \"active_stress\"\nactivity = {:.17g}", activity));
}

CaseText& CaseText::read(const std::string& fields) { return section("output", "fields = [" + fields + "]"); }

CaseText& CaseText::modes(const std::string& name, const std::string& rows) {
  return section(name, "type = \"modes\"\nmodes = " + rows);
}

std::string CaseText::text() const {
  std::string text = "title = \"test\"\n";
  for (const auto& [name, lines] : sections_) text += "[" + name + "]\n" + lines + "\n";
  return text;
}

}  // namespace mesogen::test
