#include "particles/field_loops_impl.hpp"

namespace mesogen::exec {

template class FieldLoopsImpl<float>;
template class FieldLoopsImpl<double>;

}  // namespace mesogen::exec
