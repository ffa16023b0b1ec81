// A kernel plugin whose descriptor can be spoilt by definitions.
#include "mesogen/plugin/kernel.hpp"

#include "mesogen/plugin/plugin.hpp"

#ifndef MAGIC
#define MAGIC mesogen::descriptor_magic
#endif
#ifndef ABI
#define ABI mesogen::abi_number
#endif
#ifndef SIZE
#define SIZE sizeof(mesogen::PluginDescriptor)
#endif
#ifndef TAG
#define TAG MESOGEN_BUILD_TAG
#endif
#ifndef NAME
#define NAME "spoilt"
#endif
#ifndef VERSION
#define VERSION "1.0.0"
#endif
#ifndef SUMMARY
#define SUMMARY "Cubic spline"
#endif

namespace {

class Cubic final : public mesogen::Kernel {
 public:
  [[nodiscard]] mesogen::sph::KernelShape shape() const override {
#ifdef NO_PIECES
    return {.pieces = {}, .power = 3};
#else
    return {.pieces = {{2.0, {1.0}}, {1.0, {-4.0}}}, .power = 3};
#endif
  }
};

constexpr mesogen::PluginDescriptor descriptor{MAGIC,
                                               ABI,
                                               SIZE,
                                               TAG,
                                               mesogen::PluginKind::kernel,
                                               NAME,
                                               VERSION,
                                               SUMMARY,
                                               mesogen::DimensionSet{2, 3},
                                               &mesogen::detail::create_class<mesogen::Kernel, Cubic>};

}  // namespace

MESOGEN_EXPORT_DESCRIPTOR(descriptor)
