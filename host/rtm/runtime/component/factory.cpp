// SPDX-License-Identifier: Apache-2.0
// Creation and deletion of the components of one type, and the number in their instance names. OpenRTM-aist:
// class FactoryCXX and the numbering policy `process_unique`.
#include <algorithm>
#include <rtm/Factory.h>
#include <rtm/RTObject.h>

namespace RTM {

// Returns the lowest unused number. The number of a deleted component is used again.
std::string ProcessUniquePolicy::onCreate(void* object) {
    std::lock_guard<std::mutex> lock(mutex_);
    auto unused = std::find(objects_.begin(), objects_.end(), nullptr);
    const auto number = unused - objects_.begin();
    if (unused == objects_.end())
        objects_.push_back(object);
    else
        *unused = object;
    return std::to_string(number);
}

void ProcessUniquePolicy::onDelete(void* object) {
    std::lock_guard<std::mutex> lock(mutex_);
    std::replace(objects_.begin(), objects_.end(), object, static_cast<void*>(nullptr));
}

} // namespace RTM

namespace RTC {

// If naming fails, the object is destroyed by m_Delete, the function of the object's library.
RTObject_impl* FactoryCXX::create(Manager* manager) {
    std::unique_ptr<RTObject_impl, RtcDeleteFunc> object(m_New(manager), m_Delete);
    if (object == nullptr) return nullptr;
    ++m_Number;
    object->setProperties(m_Profile);
    const std::string name = m_Profile.getProperty("type_name") + m_policy->onCreate(object.get());
    object->setInstanceName(name.c_str());
    return object.release();
}

void FactoryCXX::destroy(RTObject_impl* comp) {
    --m_Number;
    m_policy->onDelete(comp);
    m_Delete(comp);
}

} // namespace RTC
