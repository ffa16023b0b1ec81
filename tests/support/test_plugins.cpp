#include "test_plugins.hpp"

namespace mesogen::test {

const PluginRegistry& built_plugins() {
  static const PluginRegistry registry = PluginRegistry::only({MESOGEN_TEST_PLUGIN_FOLDER});
  return registry;
}

}  // namespace mesogen::test
