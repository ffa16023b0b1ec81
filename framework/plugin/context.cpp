#include "mesogen/plugin/context.hpp"

namespace mesogen {

PassContext::~PassContext() = default;

const mesh::DeviceMesh* PassContext::device_mesh() const { return nullptr; }

const exec::Sharing* PassContext::sharing() const { return nullptr; }

}  // namespace mesogen
