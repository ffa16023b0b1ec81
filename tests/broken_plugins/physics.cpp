// A physics plugin that breaks one promise: which, says its parameter `misdeed`, or a definition where it has none yet.
#include "mesogen/plugin/physics.hpp"

#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/plugin.hpp"

#ifndef NAME
#define NAME "misbehaving"
#endif
#ifdef THROW_IN_CONSTRUCTOR
constexpr bool throws_in_constructor = true;
#else
constexpr bool throws_in_constructor = false;
#endif
#ifdef THROW_IN_PARAMETERS
constexpr bool throws_in_parameters = true;
#else
constexpr bool throws_in_parameters = false;
#endif
#ifndef SECOND_PARAMETER
#define SECOND_PARAMETER "after"
#endif

namespace {

using namespace mesogen;

template <class Real, int Dim>
class Misbehaving final : public Physics {
 public:
  Misbehaving() {
    if (throws_in_constructor) throw std::runtime_error("nobody expects this");
  }

  void parameters(ParameterList& list) override {
    if (throws_in_parameters) throw 42;
    list.text("misdeed", misdeed_).required().doc("what to do wrong");
    list.number(SECOND_PARAMETER, after_).unit("s").at_least(0.0).doc("only from this time on");
  }

  void publish(Scene&) const override { fail_if("publish throws"); }

  void declare(const Scene&, PassList& list) override {
    fail_if("");
    fail_if("declare throws");
    if (misdeed_ == "declare throws an Error") throw Error(ExitCode::bad_case, "take another misdeed");
    list.field("good", Rank::scalar);
    list.field("bad", Rank::scalar);
    if (misdeed_ == "cycle") {
      list.pass("good from bad").reads({"bad"}).writes({"good"});
      list.pass("bad from good").reads({"good"}).writes({"bad"});
    } else if (misdeed_ == "two writers") {
      list.pass("first").writes({"good"});
      list.pass("second").writes({"good"});
    } else if (misdeed_ == "reads what nobody has") {
      list.pass("work").reads({"unheard_of"}).writes({"good"});
    } else if (misdeed_ == "reads what nobody writes") {
      list.pass("work").reads({"bad"}).accumulates({"acceleration"});
    } else if (misdeed_ == "watch throws") {
      list.field("clock", Rank::scalar).advanced_by("pace").watched_by([this](double, double) {
        if (late_) fail_if("watch throws");
        return std::string();
      });
      list.field("pace", Rank::scalar);
      list.pass("work").accumulates({"pace"}).run(
          [this](const PassContext& context) { late_ = context.time() >= after_; });
    } else {
      list.pass("work").reads({"velocity"}).accumulates({"acceleration"}).run([this](const PassContext& context) {
        if (context.time() >= after_) work(context);
      });
    }
  }

 private:
  using Other = std::conditional_t<std::is_same_v<Real, double>, float, double>;

  void fail_if(const std::string& misdeed) const {
    if (misdeed_ == misdeed) throw std::runtime_error("cannot do \"" + misdeed + "\"");
  }

  void work(const PassContext& context) const {
    fail_if("pass throws");
    if (misdeed_ == "pass throws an Error") throw Error(ExitCode::run_failed, "the film has dried out");
    if (misdeed_ == "pass throws a number") throw 42;
    if (misdeed_ == "pass needs too much memory") throw std::bad_alloc();
    if (misdeed_ == "particle throws")
      exec::for_each(context.space(), context.count(), [](Index i) {
        if (i == 3) throw std::runtime_error("particle 3 is bad");
      });
    if (misdeed_ == "reads undeclared") (void)context.read<Real>("density");
    if (misdeed_ == "writes undeclared") (void)context.write<Real>("velocity");
    if (misdeed_ == "reads in another precision") (void)context.read<Other>("velocity");
    if (misdeed_ == "keeps a pointer") keep_pushing(context);
    if (misdeed_ == "neighbours in another precision") (void)context.neighbours<Other, Dim>();
  }

  // By the velocity of whoever stands at this place in storage, as it was found at the first time.
  void keep_pushing(const PassContext& context) const {
    if (!kept_) kept_ = context.read<Real>("velocity");
    const auto acceleration = context.write<Real>("acceleration");
    exec::for_each(context.space(), context.count(),
                   [=, velocity = kept_](Index i) { acceleration(0, i) -= Real(1e-3) * velocity(0, i); });
  }

  bool late_ = false;
  mutable FieldView<const Real> kept_;
  std::string misdeed_;
  double after_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Misbehaving, NAME, "1.0.0", "Breaks a promise")
