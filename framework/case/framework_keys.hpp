#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"

/// The keys that the framework itself reads, bound to a case: for reading, for messages and for writing it back.
/// Where keys depend on a type, the lists hold those of the type that the case has now.
namespace mesogen::case_keys {

ParameterList domain(Case::Domain& domain);
ParameterList particles(Case::Particles& particles);
ParameterList kernel(double& smoothing_length_ratio);
ParameterList director(Case::Director& director);
ParameterList velocity(Case::Velocity& velocity);
ParameterList colour(Case::Colour& colour);
ParameterList time(Case::Time& time);
ParameterList output(Case::Output& output);
/// `precision` holds the word for Case::Run::precision.
ParameterList run(Case::Run& run, std::string& precision);

/// A key that means something only beside a certain value of another.
struct IdleKey {
  std::string key;
  bool applies;
  std::string condition;  ///< "type = \"modes\""
};
std::vector<IdleKey> idle_keys(const Case::Particles& particles);
std::vector<IdleKey> idle_keys(const Case::Director& director);
std::vector<IdleKey> idle_keys(const Case::Velocity& velocity);
std::vector<IdleKey> idle_keys(const Case::Time& time);

}  // namespace mesogen::case_keys
