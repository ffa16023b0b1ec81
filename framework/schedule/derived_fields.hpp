#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "schedule/catalogue.hpp"
#include "schedule/prescribed_fields.hpp"
#include "schedule/state.hpp"

namespace mesogen {

namespace sph {
template <class Real, int Dim>
struct FixedWeights;
template <class Real, int Dim>
struct Derivatives;
}  // namespace sph
namespace exec {
template <class Real>
struct StageArguments;
}

/// The fields that the framework offers: volume, correction, gradients and Laplacians. Each is made when asked for,
/// and only if what it depends on has changed since. Those that the integration needs and whose sources keep still
/// while rates are computed share their passes over the pairs. Where particles never move, derivatives that are made
/// at every step are sums with weights that are found once; in stabilised steps, so are Laplacians of a step's stages.
class MESOGEN_EXPORT DerivedFields {
 public:
  struct Form {
    bool consistent_laplacian = false;
    bool particles_move = true;
    bool stages = false;  ///< laplacian() will be called many times in a step
  };
  /// `prescribed`: fields from which others may be derived; null: there are none.
  DerivedFields(State& state, const Catalogue& catalogue, const std::set<std::string>& for_integration,
                const std::vector<std::set<std::string>>& for_readers, const Form& form,
                PrescribedFields* prescribed = nullptr);
  DerivedFields(const DerivedFields&) = delete;
  DerivedFields& operator=(const DerivedFields&) = delete;
  ~DerivedFields();

  [[nodiscard]] bool has(const std::string& field) const { return pass_of_.contains(field); }
  [[nodiscard]] bool prescribes(const std::string& field) const {
    return prescribed_ != nullptr && prescribed_->has(field);
  }
  /// As long as it lives, stages will need the weights of pairs where particles now are: one of the passes over pairs
  /// finds them beside what it makes.
  class BeforeStages {
   public:
    explicit BeforeStages(DerivedFields& fields) : fields_(fields) { fields_.stages_follow_ = true; }
    ~BeforeStages() { fields_.stages_follow_ = false; }
    BeforeStages(const BeforeStages&) = delete;
    BeforeStages& operator=(const BeforeStages&) = delete;

   private:
    DerivedFields& fields_;
  };
  /// Brings a derived field, or one that is prescribed, up to date.
  void make(const std::string& field);
  /// The Laplacian of any field now, which is brought up to date at ghosts and walls; `result` has as many components.
  void laplacian(Field& source, Field& result);
  /// A stage of a stabilised step, with the Laplacian of its latest increments, which `arguments` need not have yet.
  /// `room`: for that Laplacian.
  template <class Real>
  void stage(Field& latest, exec::StageArguments<Real> arguments, Field& room);

  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  struct Component {
    Field* source;
    int index;
    Field* gradient;   // may be null
    Field* laplacian;  // may be null
  };
  struct Weights;  // of pairs, in the run's precision and dimension
  template <class Real, int Dim>
  struct WeightsOf;
  struct PairPass {
    std::vector<Component> components;
    Field* correction = nullptr;
    bool volume = false;
    bool by_weights = false;             // otherwise computed anew at each run
    bool finds_weights = false;          // of the stages that follow
    std::uint64_t positions = 0;         // version of the neighbourhood when last run
    std::vector<std::uint64_t> sources;  // versions of the sources then
    Counter counter;
  };
  using Wanted = std::map<std::string, std::pair<bool, bool>>;  // source -> gradient, Laplacian

  void add_passes(const Wanted& wanted, bool correction, bool at_each_step);
  [[nodiscard]] bool stale(const PairPass& pass) const;
  void run(PairPass& pass);
  template <class Real, int Dim>
  void run_pair_sums(PairPass& pass);
  void refresh_for_sums(Field& source);
  template <class Real, int Dim>
  void run_laplacian(Field& source, Field& result);
  [[nodiscard]] bool weights_stale() const;
  template <class Real, int Dim>
  void find_weights(const Neighbours<Real, Dim>& neighbours, const sph::Derivatives<Real, Dim>& beside);
  template <class Real, int Dim>
  const sph::FixedWeights<Real, Dim>& weights(const Neighbours<Real, Dim>& neighbours);

  State& state_;
  PrescribedFields* prescribed_;
  Form form_;
  std::vector<PairPass> passes_;
  std::map<std::string, std::vector<std::size_t>> pass_of_;
  std::unique_ptr<Weights> weights_;  // null: none are kept
  bool stages_follow_ = false;
  Counter finding_{"framework: weights of pairs"};
  Counter staging_{"framework: Laplacians of stages"};
};

}  // namespace mesogen
