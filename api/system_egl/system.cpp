// Finding the system's libEGL. It has the name that ours has, so it is looked for file by file.

#include "api/system_egl/system.hpp"

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <dlfcn.h>

namespace vtm::egl {

namespace {

constexpr const char* fileName = "/libEGL.so.1";

/// The library that this code is in; null: the program.
void* ourselves() {
    Dl_info info;
    if (dladdr(reinterpret_cast<void*>(&systemEgl), &info) == 0)
        return nullptr;
    return dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
}

/// Where the loader looks, in its order.
std::vector<std::string> loaderFolders() {
    std::vector<std::string> folders;
#ifdef __GLIBC__
    if (void* const library = ourselves()) {
        Dl_serinfo size;
        if (dlinfo(library, RTLD_DI_SERINFOSIZE, &size) == 0) {
            const std::unique_ptr<char[]> room(new char[size.dls_size]);
            auto* const info = new (room.get()) Dl_serinfo(size);
            if (dlinfo(library, RTLD_DI_SERINFO, info) == 0)
                for (unsigned i = 0; i < info->dls_cnt; ++i)
                    folders.emplace_back(info->dls_serpath[i].dls_name);
        }
        dlclose(library);
    }
#endif
    for (const char* folder :
         {"/usr/local/lib", "/usr/lib64", "/usr/lib", "/lib64", "/lib", "/usr/lib/x86_64-linux-gnu",
          "/usr/lib/aarch64-linux-gnu", "/usr/lib/arm-linux-gnueabihf", "/usr/lib/i386-linux-gnu"})
        folders.emplace_back(folder);
    return folders;
}

/// A library of ours knows the functions of vtm/vg.h, wherever it was copied to: forwarding to it would come
/// back to us.
bool isOurs(const System& system) {
    // Ours must not be called before it knows of a system's.
    void* const library = ourselves();
    const bool isThisOne =
        library && dlsym(library, "eglGetProcAddress") == reinterpret_cast<void*>(system.GetProcAddress);
    if (library)
        dlclose(library);
    return isThisOne || system.GetProcAddress("vtmCreateContext") != nullptr;
}

const System* load(const std::string& path) {
    void* const library = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!library)
        return nullptr;
    auto result = std::make_unique<System>();
#define VTM_EGL_LOAD(name) \
    result->name = reinterpret_cast<decltype(&::egl##name)>(dlsym(library, "egl" #name));
    VTM_EGL_FUNCTIONS(VTM_EGL_LOAD)
#undef VTM_EGL_LOAD
    // GetCurrentContext came last of those that we do not do without.
    if (!result->GetProcAddress || !result->GetCurrentContext || !result->BindAPI || isOurs(*result)) {
        dlclose(library);
        return nullptr;
    }
    return result.release();
}

const System* find() {
    const char* const named = std::getenv("VTM_SYSTEM_EGL");
    if (named && *named)
        return std::string(named) == "none" ? nullptr : load(named);
    for (const std::string& folder : loaderFolders())
        if (const System* const system = load(folder + fileName))
            return system;
    return nullptr;
}

}  // namespace

const System* systemEgl() {
    static const System* const system = find();
    return system;
}

}  // namespace vtm::egl
