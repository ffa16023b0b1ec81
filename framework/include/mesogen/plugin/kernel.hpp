#pragma once

#include "mesogen/fields/dimensions.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/sph/kernel_shape.hpp"

namespace mesogen {

/// A smoothing kernel: data only, so choosing it at run time costs nothing in the pair loops.
class MESOGEN_EXPORT Kernel {
 public:
  /// Dimensions that it has a form for. A plugin of fewer declares the same public member again.
  static constexpr DimensionSet dimensions{AllDimensions{}};

  Kernel() = default;
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;
  virtual ~Kernel();

  /// Keys beside the framework's own (type, smoothing_length).
  virtual void parameters(ParameterList& list);
  /// The kernel's form in q = r / h; the framework normalises and checks it.
  [[nodiscard]] virtual sph::KernelShape shape() const = 0;
};

}  // namespace mesogen
