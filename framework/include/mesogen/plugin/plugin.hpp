#pragma once

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/descriptor.hpp"

/// Makes a library a plugin. At the end of its source, outside any namespace, one of
///
///     MESOGEN_PHYSICS_PLUGIN(Friction, "friction", "1.0.0", "Linear friction on a substrate")    // class template
///     MESOGEN_KERNEL_PLUGIN(Quintic, "quintic", "1.0.0", "Quintic spline")                       // class
///
/// and likewise BOUNDARY, SHAPE, INITIAL and OBSERVER (classes). A physics plugin is a class template <class Real, int
/// Dim>.
///
/// A plugin that works in any dimension says nothing. One that does not says so in one line, and a case of another
/// dimension is refused:
///
///     template <class Real, int Dim> requires(Dim == 2) class FlowFields ...     // physics: a constraint
///     static constexpr DimensionSet dimensions{2};                               // other classes: a public member
namespace mesogen::detail {

template <class Base, class Plugin>
void* create_class(Precision /*precision*/, int /*dimension*/) {
  return static_cast<Base*>(new Plugin);
}

/// Does the constraint of a class template allow these arguments? Nothing of the class is instantiated.
/// `Forms::Form` is the class template: one that has a constraint can be no template argument itself.
template <class Forms, class Real, int Dim>
concept HasForm = requires {
  typename Forms::template Form<Real, Dim>;
};

template <class Forms, int... Dims>
constexpr DimensionSet dimensions_of_forms(Dimensions<Dims...> /*all*/) {
  return {(HasForm<Forms, float, Dims> || HasForm<Forms, double, Dims> ? Dims : -1)...};
}

template <class Base, class Forms>
void* create_form(Precision precision, int dimension) {
  return dispatch(precision, dimension, [&]<class Real, int Dim>() -> void* {
    if constexpr (HasForm<Forms, Real, Dim>) {
      return static_cast<Base*>(new typename Forms::template Form<Real, Dim>);
    } else {
      return nullptr;
    }
  });
}

}  // namespace mesogen::detail

#define MESOGEN_PLUGIN_(KIND, NAME, VERSION, SUMMARY, DIMENSIONS, CREATE)               \
  namespace mesogen_plugin_export {                                                     \
  /* Internal to the library: only the pointer below is exported. */                    \
  constexpr ::mesogen::PluginDescriptor descriptor{::mesogen::descriptor_magic,         \
                                                   ::mesogen::abi_number,               \
                                                   sizeof(::mesogen::PluginDescriptor), \
                                                   MESOGEN_BUILD_TAG,                   \
                                                   ::mesogen::PluginKind::KIND,         \
                                                   NAME,                                \
                                                   VERSION,                             \
                                                   SUMMARY,                             \
                                                   DIMENSIONS,                          \
                                                   CREATE};                             \
  }                                                                                     \
  MESOGEN_EXPORT_DESCRIPTOR(mesogen_plugin_export::descriptor)

#define MESOGEN_CLASS_PLUGIN_(KIND, BASE, CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_PLUGIN_(KIND, NAME, VERSION, SUMMARY, CLASS::dimensions, (&::mesogen::detail::create_class<BASE, CLASS>))

#define MESOGEN_KERNEL_PLUGIN(CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_CLASS_PLUGIN_(kernel, ::mesogen::Kernel, CLASS, NAME, VERSION, SUMMARY)
#define MESOGEN_BOUNDARY_PLUGIN(CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_CLASS_PLUGIN_(boundary, ::mesogen::Boundary, CLASS, NAME, VERSION, SUMMARY)
#define MESOGEN_SHAPE_PLUGIN(CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_CLASS_PLUGIN_(shape, ::mesogen::Shape, CLASS, NAME, VERSION, SUMMARY)
#define MESOGEN_INITIAL_PLUGIN(CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_CLASS_PLUGIN_(initial, ::mesogen::Initial, CLASS, NAME, VERSION, SUMMARY)
#define MESOGEN_OBSERVER_PLUGIN(CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_CLASS_PLUGIN_(observer, ::mesogen::Observer, CLASS, NAME, VERSION, SUMMARY)
#define MESOGEN_PHYSICS_PLUGIN(CLASS, NAME, VERSION, SUMMARY)                                                       \
  namespace mesogen_plugin_export {                                                                                 \
  struct Forms {                                                                                                    \
    template <class Real, int Dim>                                                                                  \
    using Form = CLASS<Real, Dim>;                                                                                  \
  };                                                                                                                \
  }                                                                                                                 \
  MESOGEN_PLUGIN_(physics, NAME, VERSION, SUMMARY,                                                                  \
                  ::mesogen::detail::dimensions_of_forms<mesogen_plugin_export::Forms>(::mesogen::AllDimensions{}), \
                  (&::mesogen::detail::create_form<::mesogen::Physics, mesogen_plugin_export::Forms>))
