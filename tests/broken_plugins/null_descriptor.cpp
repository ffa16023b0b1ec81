// Exports the right name, but nothing behind it.
extern "C" {
extern __attribute__((visibility("default"))) const void* const mesogen_plugin;
const void* const mesogen_plugin = nullptr;
}
