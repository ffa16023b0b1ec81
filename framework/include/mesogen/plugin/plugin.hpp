#pragma once

#include <boost/dll/alias.hpp>

#include "mesogen/plugin/descriptor.hpp"

/// Makes a library a plugin. At the end of its source, outside any namespace, one of
///
///     MESOGEN_PHYSICS_PLUGIN(Friction, "friction", "1.0.0", "Linear friction on a substrate")    // class template
///     MESOGEN_KERNEL_PLUGIN(Quintic, "quintic", "1.0.0", "Quintic spline")                       // class
///
/// and likewise BOUNDARY, INITIAL and OBSERVER (classes). A physics plugin is a class template <class Real, int Dim>.
namespace mesogen::detail {

template <class Base, class Derived>
void* create_plain(Precision, int) {
  return static_cast<Base*>(new Derived);
}

template <class Base, template <class, int> class Derived>
void* create_templated(Precision precision, int dimension) {
  if (dimension != 2) return nullptr;
  if (precision == Precision::single_precision) return static_cast<Base*>(new Derived<float, 2>);
  return static_cast<Base*>(new Derived<double, 2>);
}

}  // namespace mesogen::detail

#define MESOGEN_PLUGIN_(KIND, CREATE, NAME, VERSION, SUMMARY)                           \
  namespace mesogen_plugin_export {                                                     \
  /* Internal to the library: only the alias below is exported. */                      \
  constexpr ::mesogen::PluginDescriptor descriptor{::mesogen::descriptor_magic,         \
                                                   ::mesogen::abi_number,               \
                                                   sizeof(::mesogen::PluginDescriptor), \
                                                   MESOGEN_BUILD_TAG,                   \
                                                   ::mesogen::PluginKind::KIND,         \
                                                   NAME,                                \
                                                   VERSION,                             \
                                                   SUMMARY,                             \
                                                   CREATE};                             \
  }                                                                                     \
  BOOST_DLL_ALIAS(mesogen_plugin_export::descriptor, mesogen_plugin)

#define MESOGEN_KERNEL_PLUGIN(CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_PLUGIN_(kernel, (&::mesogen::detail::create_plain<::mesogen::Kernel, CLASS>), NAME, VERSION, SUMMARY)
#define MESOGEN_BOUNDARY_PLUGIN(CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_PLUGIN_(boundary, (&::mesogen::detail::create_plain<::mesogen::Boundary, CLASS>), NAME, VERSION, SUMMARY)
#define MESOGEN_INITIAL_PLUGIN(CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_PLUGIN_(initial, (&::mesogen::detail::create_plain<::mesogen::Initial, CLASS>), NAME, VERSION, SUMMARY)
#define MESOGEN_OBSERVER_PLUGIN(CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_PLUGIN_(observer, (&::mesogen::detail::create_plain<::mesogen::Observer, CLASS>), NAME, VERSION, SUMMARY)
#define MESOGEN_PHYSICS_PLUGIN(CLASS, NAME, VERSION, SUMMARY) \
  MESOGEN_PLUGIN_(physics, (&::mesogen::detail::create_templated<::mesogen::Physics, CLASS>), NAME, VERSION, SUMMARY)
