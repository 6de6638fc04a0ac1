// What stands between the loader and the driver: each function is found by its name, counts its calls, and passes them
// on unless they are to fail. See "Loader and layer interface" of the Vulkan loader.
#include "tests/faults/fakes.h"
#include "tests/faults/fault_layer.h"
#include "tests/faults/flips.h"
#include "tests/faults/plan.h"

#include <vulkan/vk_layer.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace hyalite::faults {

namespace {

// Everything that returns a VkResult and is passed on as it is.
#define HYALITE_INSTANCE_CALLS(X)                                                                            \
    X(vkEnumeratePhysicalDevices)                                                                            \
    X(vkCreateDebugUtilsMessengerEXT)
#define HYALITE_DEVICE_CALLS(X)                                                                              \
    X(vkAllocateCommandBuffers)                                                                              \
    X(vkAllocateDescriptorSets)                                                                              \
    X(vkAllocateMemory)                                                                                      \
    X(vkBeginCommandBuffer)                                                                                  \
    X(vkCreateBufferView)                                                                                    \
    X(vkCreateAccelerationStructureKHR)                                                                      \
    X(vkCreateCommandPool)                                                                                   \
    X(vkCreateComputePipelines)                                                                              \
    X(vkCreateDescriptorPool)                                                                                \
    X(vkCreateDescriptorSetLayout)                                                                           \
    X(vkCreateFence)                                                                                         \
    X(vkCreatePipelineLayout)                                                                                \
    X(vkCreateQueryPool)                                                                                     \
    X(vkDeviceWaitIdle)                                                                                      \
    X(vkEndCommandBuffer)                                                                                    \
    X(vkGetQueryPoolResults)                                                                                 \
    X(vkResetFences)                                                                                         \
    X(vkWaitForFences)
// What undoes them.
#define HYALITE_DESTROY_CALLS(X)                                                                             \
    X(vkDestroyAccelerationStructureKHR, "vkCreateAccelerationStructureKHR")                                 \
    X(vkDestroyBufferView, "vkCreateBufferView")                                                             \
    X(vkDestroyCommandPool, "vkCreateCommandPool")                                                           \
    X(vkDestroyDescriptorPool, "vkCreateDescriptorPool")                                                     \
    X(vkDestroyDescriptorSetLayout, "vkCreateDescriptorSetLayout")                                           \
    X(vkDestroyFence, "vkCreateFence")                                                                       \
    X(vkDestroyPipeline, "vkCreateComputePipelines")                                                         \
    X(vkDestroyPipelineLayout, "vkCreatePipelineLayout")                                                     \
    X(vkDestroyQueryPool, "vkCreateQueryPool")                                                               \
    X(vkDestroyShaderModule, "vkCreateShaderModule")                                                         \
    X(vkFreeMemory, "vkAllocateMemory")

/// What comes after this layer, for one instance or device.
struct Next {
    VkInstance instance;
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr; ///< of a device only
    /// Our functions' successors. They are asked for when the object is made: once the loader's dispatch table is
    /// complete, its end of the chain answers with the beginning.
    std::map<std::string_view, PFN_vkVoidFunction> functions;
};

using Functions = std::map<std::string_view, PFN_vkVoidFunction>;

const Functions &instanceFunctions();
const Functions &deviceFunctions();
std::vector<const char *> namesOf(const Functions &functions);

std::mutex nextMutex;
/// By the loader's dispatch table, which all objects of an instance or device begin with.
std::map<void *, Next> nextOfTable;

template <class Object> void *tableOf(Object object) { return *reinterpret_cast<void **>(object); }

template <class Object> Next nextOf(Object object) {
    const std::lock_guard lock(nextMutex);
    return nextOfTable.at(tableOf(object));
}

template <class Function, class Object> Function nextFunction(Object object, const char *name) {
    const std::lock_guard lock(nextMutex);
    const auto &functions = nextOfTable.at(tableOf(object)).functions;
    const auto found = functions.find(name);
    return found != functions.end() ? reinterpret_cast<Function>(found->second) : nullptr;
}

template <std::size_t size> struct Text {
    char characters[size];
    constexpr Text(const char (&text)[size]) { std::copy(text, text + size, characters); }
};

/// While it lives, and if it is wanted, no limit on the sizes of files holds: Mesa 25 and later allocate memory as
/// files, which a limit that stands in for a full disk must not touch.
class UnlimitedFiles {
  public:
    UnlimitedFiles() : isWanted_(plan().isFaked("unlimited-memory-files")) {
        const std::lock_guard lock(mutex_);
        if (!isWanted_ || count_++ > 0)
            return;
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit unlimited{before_.rlim_max, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &unlimited);
    }
    ~UnlimitedFiles() {
        const std::lock_guard lock(mutex_);
        if (isWanted_ && --count_ == 0)
            setrlimit(RLIMIT_FSIZE, &before_);
    }
    UnlimitedFiles(const UnlimitedFiles &) = delete;
    UnlimitedFiles &operator=(const UnlimitedFiles &) = delete;

  private:
    // The limit is that of the process, and calls of several threads overlap.
    static inline std::mutex mutex_;
    static inline int count_ = 0;
    static inline rlimit before_{};
    bool isWanted_;
};

// ---- Calls that are passed on

template <Text name, class Function> struct Passed;
template <Text name, class First, class... Rest> struct Passed<name, VkResult(VKAPI_PTR *)(First, Rest...)> {
    using Function = VkResult(VKAPI_PTR *)(First, Rest...);
    static VKAPI_ATTR VkResult VKAPI_CALL call(First first, Rest... rest) {
        const auto next = nextFunction<Function>(first, name.characters);
        const UnlimitedFiles unlimited;
        const VkResult fault = plan().countCall(name.characters);
        // A device that is lost does not work any more; one that only takes too long goes on.
        if (fault == VK_SUCCESS ||
            (fault != VK_TIMEOUT && std::strcmp(name.characters, "vkWaitForFences") == 0)) {
            const VkResult result = next != nullptr ? next(first, rest...) : VK_SUCCESS;
            if (fault == VK_SUCCESS) {
                if (result == VK_SUCCESS)
                    countObject();
                return result;
            }
        }
        return fault;
    }
    static void countObject() {
        const std::string_view text = name.characters;
        if (text.starts_with("vkCreate") || text == "vkAllocateMemory")
            plan().countCreated(name.characters);
    }
};

template <Text name, Text creator, class Function> struct Destroyer;
template <Text name, Text creator, class Parent, class Object>
struct Destroyer<name, creator, void(VKAPI_PTR *)(Parent, Object, const VkAllocationCallbacks *)> {
    using Function = void(VKAPI_PTR *)(Parent, Object, const VkAllocationCallbacks *);
    static VKAPI_ATTR void VKAPI_CALL call(Parent parent, Object object,
                                           const VkAllocationCallbacks *allocator) {
        if (object != VK_NULL_HANDLE)
            plan().countDestroyed(creator.characters);
        nextFunction<Function>(parent, name.characters)(parent, object, allocator);
    }
};

// ---- Instances and devices

/// The loader's link to the next layer in a chain of creation structures.
template <class Link, VkStructureType type> Link *findLink(const void *chain) {
    for (auto *part = static_cast<const Link *>(chain); part != nullptr;
         part = static_cast<const Link *>(part->pNext))
        if (part->sType == type && part->function == VK_LAYER_LINK_INFO)
            return const_cast<Link *>(part);
    return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo *info,
                                              const VkAllocationCallbacks *allocator, VkInstance *instance) {
    if (const VkResult fault = plan().countCall("vkCreateInstance"); fault != VK_SUCCESS)
        return fault;
    auto *link =
        findLink<VkLayerInstanceCreateInfo, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO>(info->pNext);
    const PFN_vkGetInstanceProcAddr getNext = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(getNext(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, allocator, instance);
    if (result != VK_SUCCESS)
        return result;
    plan().countCreated("vkCreateInstance");
    Next next{*instance, getNext, nullptr, {}};
    for (const Functions *functions : {&instanceFunctions(), &deviceFunctions()})
        for (const char *name : namesOf(*functions))
            next.functions[name] = getNext(*instance, name);
    const std::lock_guard lock(nextMutex);
    nextOfTable[tableOf(*instance)] = std::move(next);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyInstance(VkInstance instance, const VkAllocationCallbacks *allocator) {
    if (instance == VK_NULL_HANDLE)
        return;
    plan().countDestroyed("vkCreateInstance");
    void *const table = tableOf(instance);
    nextFunction<PFN_vkDestroyInstance>(instance, "vkDestroyInstance")(instance, allocator);
    const std::lock_guard lock(nextMutex);
    nextOfTable.erase(table);
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo *info,
                                            const VkAllocationCallbacks *allocator, VkDevice *device) {
    if (const VkResult fault = plan().countCall("vkCreateDevice"); fault != VK_SUCCESS)
        return fault;
    const UnlimitedFiles unlimited;
    auto *link = findLink<VkLayerDeviceCreateInfo, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO>(info->pNext);
    const PFN_vkGetInstanceProcAddr getInstanceNext = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    const PFN_vkGetDeviceProcAddr getDeviceNext = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const VkInstance instance = nextOf(physical).instance;
    // Extensions that only we offer.
    std::vector<const char *> extensions(info->ppEnabledExtensionNames,
                                         info->ppEnabledExtensionNames + info->enabledExtensionCount);
    const auto removed = [&](const char *extension) {
        return std::erase_if(extensions, [&](const char *name) { return std::strcmp(name, extension) == 0; });
    };
    if (plan().isFaked("calibrated"))
        removed(VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME);
    if (plan().isFaked("portability") && removed("VK_KHR_portability_subset") == 0)
        return VK_ERROR_INITIALIZATION_FAILED; // the specification demands it
    VkDeviceCreateInfo passed = *info;
    passed.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    passed.ppEnabledExtensionNames = extensions.data();
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(getInstanceNext(instance, "vkCreateDevice"));
    const VkResult result = create(physical, &passed, allocator, device);
    if (result != VK_SUCCESS)
        return result;
    plan().countCreated("vkCreateDevice");
    Next next{instance, getInstanceNext, getDeviceNext, {}};
    for (const char *name : namesOf(deviceFunctions()))
        next.functions[name] = getDeviceNext(*device, name);
    const std::lock_guard lock(nextMutex);
    nextOfTable[tableOf(*device)] = std::move(next);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice device, const VkAllocationCallbacks *allocator) {
    if (device == VK_NULL_HANDLE)
        return;
    plan().countDestroyed("vkCreateDevice");
    void *const table = tableOf(device);
    nextFunction<PFN_vkDestroyDevice>(device, "vkDestroyDevice")(device, allocator);
    const std::lock_guard lock(nextMutex);
    nextOfTable.erase(table);
}

// ---- What a device says of itself

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties *properties) {
    nextFunction<PFN_vkGetPhysicalDeviceProperties>(device, "vkGetPhysicalDeviceProperties")(device,
                                                                                             properties);
    fakeProperties(*properties);
}

VKAPI_ATTR void VKAPI_CALL getProperties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2 *properties) {
    nextFunction<PFN_vkGetPhysicalDeviceProperties2>(device, "vkGetPhysicalDeviceProperties2")(device,
                                                                                               properties);
    fakeProperties(properties->properties);
    fakeChain(properties->pNext);
}

VKAPI_ATTR void VKAPI_CALL getMemory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties *memory) {
    nextFunction<PFN_vkGetPhysicalDeviceMemoryProperties>(device, "vkGetPhysicalDeviceMemoryProperties")(
        device, memory);
    fakeMemory(*memory);
}

VKAPI_ATTR void VKAPI_CALL getMemory2(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties2 *memory) {
    nextFunction<PFN_vkGetPhysicalDeviceMemoryProperties2>(device, "vkGetPhysicalDeviceMemoryProperties2")(
        device, memory);
    fakeMemory(memory->memoryProperties);
}

VKAPI_ATTR void VKAPI_CALL getQueueFamilies(VkPhysicalDevice device, std::uint32_t *count,
                                            VkQueueFamilyProperties *families) {
    nextFunction<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
        device, "vkGetPhysicalDeviceQueueFamilyProperties")(device, count, families);
    for (std::uint32_t i = 0; families != nullptr && i < *count; ++i)
        fakeQueueFamily(families[i]);
}

VKAPI_ATTR VkResult VKAPI_CALL enumerateExtensions(VkPhysicalDevice device, const char *layer,
                                                   std::uint32_t *count, VkExtensionProperties *extensions) {
    if (layer != nullptr && std::strcmp(layer, "VK_LAYER_HYALITE_faults") == 0) {
        *count = 0;
        return VK_SUCCESS;
    }
    if (const VkResult fault = plan().countCall("vkEnumerateDeviceExtensionProperties"); fault != VK_SUCCESS)
        return fault;
    const auto next = nextFunction<PFN_vkEnumerateDeviceExtensionProperties>(
        device, "vkEnumerateDeviceExtensionProperties");
    std::uint32_t nextCount = 0;
    if (const VkResult result = next(device, layer, &nextCount, nullptr); result != VK_SUCCESS)
        return result;
    std::vector<VkExtensionProperties> all(nextCount);
    if (const VkResult result = next(device, layer, &nextCount, all.data()); result != VK_SUCCESS)
        return result;
    fakeExtensions(all);
    const auto allCount = static_cast<std::uint32_t>(all.size());
    if (extensions == nullptr) {
        *count = allCount;
        return VK_SUCCESS;
    }
    const std::uint32_t given = std::min(*count, allCount);
    std::copy_n(all.begin(), given, extensions);
    *count = given;
    return given < allCount ? VK_INCOMPLETE : VK_SUCCESS;
}

// ---- Calibrated timestamps, of devices whose clock is the host's, as lavapipe's

VKAPI_ATTR VkResult VKAPI_CALL getTimeDomains(VkPhysicalDevice, std::uint32_t *count,
                                              VkTimeDomainEXT *domains) {
    if (const VkResult fault = plan().countCall("vkGetPhysicalDeviceCalibrateableTimeDomainsEXT");
        fault != VK_SUCCESS)
        return fault;
    *count = 2;
    if (domains != nullptr) {
        domains[0] = VK_TIME_DOMAIN_DEVICE_EXT;
        domains[1] = VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT;
    }
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL getCalibratedTimestamps(VkDevice, std::uint32_t count,
                                                       const VkCalibratedTimestampInfoEXT *,
                                                       std::uint64_t *values, std::uint64_t *deviation) {
    if (const VkResult fault = plan().countCall("vkGetCalibratedTimestampsEXT"); fault != VK_SUCCESS)
        return fault;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    std::fill_n(values, count,
                static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000u +
                    static_cast<std::uint64_t>(now.tv_nsec));
    *deviation = 0;
    return VK_SUCCESS;
}

// ---- Functions by their names

PFN_vkVoidFunction getInstanceFunction(VkInstance instance, const char *name);
PFN_vkVoidFunction getDeviceFunction(VkDevice device, const char *name);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char *name) {
    return getInstanceFunction(instance, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char *name) {
    return getDeviceFunction(device, name);
}

VKAPI_ATTR VkResult VKAPI_CALL createShaderModule(VkDevice device, const VkShaderModuleCreateInfo *info,
                                                  const VkAllocationCallbacks *allocator,
                                                  VkShaderModule *module) {
    std::vector<std::uint32_t> words(info->pCode, info->pCode + info->codeSize / sizeof(std::uint32_t));
    fakeArithmetic(words);
    VkShaderModuleCreateInfo passed = *info;
    passed.pCode = words.data();
    return Passed<"vkCreateShaderModule", PFN_vkCreateShaderModule>::call(device, &passed, allocator, module);
}

// ---- Bits that flip

VKAPI_ATTR VkResult VKAPI_CALL createBuffer(VkDevice device, const VkBufferCreateInfo *info,
                                            const VkAllocationCallbacks *allocator, VkBuffer *buffer) {
    const VkResult result =
        Passed<"vkCreateBuffer", PFN_vkCreateBuffer>::call(device, info, allocator, buffer);
    if (result == VK_SUCCESS && flips().isWanted())
        flips().noteBuffer(*buffer, info->size);
    return result;
}

VKAPI_ATTR void VKAPI_CALL destroyBuffer(VkDevice device, VkBuffer buffer,
                                         const VkAllocationCallbacks *allocator) {
    flips().noteGone(buffer);
    Destroyer<"vkDestroyBuffer", "vkCreateBuffer", PFN_vkDestroyBuffer>::call(device, buffer, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL bindBufferMemory(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                                VkDeviceSize offset) {
    if (flips().isWanted())
        flips().noteBound(buffer, memory);
    return Passed<"vkBindBufferMemory", PFN_vkBindBufferMemory>::call(device, buffer, memory, offset);
}

VKAPI_ATTR VkResult VKAPI_CALL mapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                         VkDeviceSize size, VkMemoryMapFlags flags, void **address) {
    const VkResult result =
        Passed<"vkMapMemory", PFN_vkMapMemory>::call(device, memory, offset, size, flags, address);
    if (result == VK_SUCCESS && flips().isWanted())
        flips().noteMapped(memory, *address);
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL setObjectName(VkDevice device, const VkDebugUtilsObjectNameInfoEXT *info) {
    if (flips().isWanted())
        flips().noteName(info->objectType, info->objectHandle, info->pObjectName);
    return Passed<"vkSetDebugUtilsObjectNameEXT", PFN_vkSetDebugUtilsObjectNameEXT>::call(device, info);
}

VKAPI_ATTR void VKAPI_CALL bindPipeline(VkCommandBuffer commands, VkPipelineBindPoint point,
                                        VkPipeline pipeline) {
    if (flips().isWanted())
        flips().notePipeline(pipeline);
    nextFunction<PFN_vkCmdBindPipeline>(commands, "vkCmdBindPipeline")(commands, point, pipeline);
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo *infos,
                                           VkFence fence) {
    if (flips().isWanted())
        flips().beforeSubmission();
    return Passed<"vkQueueSubmit", PFN_vkQueueSubmit>::call(queue, count, infos, fence);
}

template <class Function> PFN_vkVoidFunction erased(Function function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

const Functions &deviceFunctions() {
    static const Functions functions{
#define HYALITE_ENTRY(name) {#name, erased(Passed<#name, PFN_##name>::call)},
        HYALITE_DEVICE_CALLS(HYALITE_ENTRY)
#undef HYALITE_ENTRY
#define HYALITE_ENTRY(name, creator) {#name, erased(Destroyer<#name, creator, PFN_##name>::call)},
            HYALITE_DESTROY_CALLS(HYALITE_ENTRY)
#undef HYALITE_ENTRY
                {"vkBindBufferMemory", erased(bindBufferMemory)},
        {"vkCmdBindPipeline", erased(bindPipeline)},
        {"vkCreateBuffer", erased(createBuffer)},
        {"vkCreateShaderModule", erased(createShaderModule)},
        {"vkDestroyBuffer", erased(destroyBuffer)},
        {"vkMapMemory", erased(mapMemory)},
        {"vkQueueSubmit", erased(queueSubmit)},
        {"vkSetDebugUtilsObjectNameEXT", erased(setObjectName)},
        {"vkDestroyDevice", erased(destroyDevice)},
        {"vkGetDeviceProcAddr", erased(getDeviceProcAddr)},
    };
    return functions;
}

const Functions &instanceFunctions() {
    static const Functions functions{
#define HYALITE_ENTRY(name) {#name, erased(Passed<#name, PFN_##name>::call)},
        HYALITE_INSTANCE_CALLS(HYALITE_ENTRY)
#undef HYALITE_ENTRY
            {"vkDestroyDebugUtilsMessengerEXT",
             erased(Destroyer<"vkDestroyDebugUtilsMessengerEXT", "vkCreateDebugUtilsMessengerEXT",
                              PFN_vkDestroyDebugUtilsMessengerEXT>::call)},
        {"vkCreateDevice", erased(createDevice)},
        {"vkCreateInstance", erased(createInstance)},
        {"vkDestroyInstance", erased(destroyInstance)},
        {"vkEnumerateDeviceExtensionProperties", erased(enumerateExtensions)},
        {"vkGetInstanceProcAddr", erased(getInstanceProcAddr)},
        {"vkGetPhysicalDeviceMemoryProperties", erased(getMemory)},
        {"vkGetPhysicalDeviceMemoryProperties2", erased(getMemory2)},
        {"vkGetPhysicalDeviceProperties", erased(getProperties)},
        {"vkGetPhysicalDeviceProperties2", erased(getProperties2)},
        {"vkGetPhysicalDeviceQueueFamilyProperties", erased(getQueueFamilies)},
    };
    return functions;
}

const Functions &calibrationFunctions() {
    static const Functions functions{
        {"vkGetCalibratedTimestampsEXT", erased(getCalibratedTimestamps)},
        {"vkGetPhysicalDeviceCalibrateableTimeDomainsEXT", erased(getTimeDomains)},
    };
    return functions;
}

std::vector<const char *> namesOf(const Functions &functions) {
    std::vector<const char *> names;
    for (const auto &[name, function] : functions)
        names.push_back(name.data()); // of a literal
    return names;
}

PFN_vkVoidFunction ourFunction(std::initializer_list<const Functions *> tables, const char *name) {
    for (const Functions *functions : tables)
        if (const auto found = functions->find(name); found != functions->end())
            return found->second;
    return nullptr;
}

PFN_vkVoidFunction getInstanceFunction(VkInstance instance, const char *name) {
    if (plan().isFaked("calibrated"))
        if (const PFN_vkVoidFunction ours = ourFunction({&calibrationFunctions()}, name))
            return ours;
    if (const PFN_vkVoidFunction ours = ourFunction({&instanceFunctions(), &deviceFunctions()}, name))
        return ours;
    return instance != VK_NULL_HANDLE ? nextOf(instance).getInstanceProcAddr(instance, name) : nullptr;
}

PFN_vkVoidFunction getDeviceFunction(VkDevice device, const char *name) {
    if (plan().isFaked("calibrated"))
        if (const PFN_vkVoidFunction ours = ourFunction({&calibrationFunctions()}, name))
            return ours;
    if (const PFN_vkVoidFunction ours = ourFunction({&deviceFunctions()}, name))
        return ours;
    return nextOf(device).getDeviceProcAddr(device, name);
}

} // namespace

} // namespace hyalite::faults

HYALITE_FAULT_API VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface *interface) {
    interface->loaderLayerInterfaceVersion = std::min(interface->loaderLayerInterfaceVersion, 2u);
    interface->pfnGetInstanceProcAddr = hyalite::faults::getInstanceProcAddr;
    interface->pfnGetDeviceProcAddr = hyalite::faults::getDeviceProcAddr;
    interface->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}

bool hyaliteCanFail(const char *function) {
    using namespace hyalite::faults;
    const std::string_view name = function;
    if (name.starts_with("vkDestroy") || name == "vkFreeMemory")
        return false;
    return ourFunction({&deviceFunctions(), &instanceFunctions(), &calibrationFunctions()}, function) !=
           nullptr;
}
