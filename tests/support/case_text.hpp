#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mesogen::test {

/// A case put together section by section: what a test varies stands in the test. It starts with a square periodic box
/// with a lattice of particles, the quintic kernel and double precision.
class CaseText {
 public:
  /// `length`: edge of the box, m; `across`: particles along it.
  CaseText(double length, int across);

  /// Puts lines into a section; in place of what stood there. Sections keep the order of their first mention.
  CaseText& section(const std::string& name, const std::string& lines);
  CaseText& boundary(const std::string& type);
  CaseText& kernel(const std::string& type, const std::string& laplacian = "consistent");
  CaseText& precision(const std::string& word);
  /// rho = 1 kg/m3; viscosity in Pa s.
  CaseText& flow(double viscosity, const std::string& more = "");
  /// The same by wcsph_published, which differs from wcsph in the keys that are given and in no other.
  CaseText& published_flow(double viscosity, const std::string& more);
  /// A = -1, C = 1/2 Pa.
  CaseText& nematic(double rotational_diffusivity, double flow_alignment, double elastic_constant);
  CaseText& active(double activity);
  /// Fields that are kept up to date for CaseRun::field beside those that the run itself needs.
  CaseText& read(const std::string& fields);
  /// [director] or [velocity] with type = "modes" and these rows.
  CaseText& modes(const std::string& section, const std::string& rows);

  [[nodiscard]] std::string text() const;

 private:
  double length_;
  std::vector<std::pair<std::string, std::string>> sections_;
};

}  // namespace mesogen::test
