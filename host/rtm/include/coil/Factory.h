// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_FACTORY_H
#define COIL_FACTORY_H
#include <coil/Properties.h>
#include <coil/Singleton.h>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace coil {

enum class FactoryReturn : std::uint8_t {
    OK,
    FACTORY_ERROR,
    ALREADY_EXISTS,
    NOT_FOUND,
    INVALID_ARG,
    UNKNOWN_ERROR
};

/// Functions for addFactory(): create and delete a ConcreteClass.
template <class AbstractClass, class ConcreteClass>
AbstractClass* Creator() {
    return new ConcreteClass();
}
template <class AbstractClass, class ConcreteClass>
void Destructor(AbstractClass*& object) {
    if (dynamic_cast<ConcreteClass*>(object) == nullptr) return;
    delete object;
    object = nullptr;
}

/// Creates objects by the name of their class. Remembers the entry that created an object, whose destructor function
/// deletes it. [any-thread]
template <class AbstractClass, typename Identifier = std::string, typename Compare = std::less<Identifier>,
          typename Creator = AbstractClass* (*)(), typename Destructor = void (*)(AbstractClass*&)>
class Factory {
    struct Entry {
        Identifier id;
        Creator creator;
        Destructor destructor;
        Properties properties;
    };

  public:
    bool hasFactory(const Identifier& id);
    std::vector<Identifier> getIdentifiers();
    Properties getProperties(const Identifier& id);
    FactoryReturn addFactory(const Identifier& id, Creator creator, Destructor destructor,
                             Properties properties = Properties());
    FactoryReturn removeFactory(const Identifier& id);
    /// Returns NULL if there is no such name. Return the object with deleteObject().
    AbstractClass* createObject(const Identifier& id);
    FactoryReturn deleteObject(const Identifier&, AbstractClass*& object) { return deleteObject(object); }
    /// Returns NOT_FOUND, without side effects, for an object that this factory has not created.
    FactoryReturn deleteObject(AbstractClass*& object);
    std::vector<AbstractClass*> createdObjects();
    bool isProducerOf(AbstractClass* object);
    FactoryReturn objectToIdentifier(AbstractClass* object, Identifier& id);

  private:
    std::map<Identifier, Entry, Compare> creators_;
    std::map<AbstractClass*, Entry> objects_;
    std::mutex mutex_;
};

// Outside the class and therefore not inline: a library that instantiates a factory explicitly contains these
// functions for all users.
template <class AbstractClass, typename Identifier, typename Compare, typename Creator, typename Destructor>
bool Factory<AbstractClass, Identifier, Compare, Creator, Destructor>::hasFactory(const Identifier& id) {
    std::lock_guard<std::mutex> lock(mutex_);
    return creators_.count(id) != 0;
}
template <class AbstractClass, typename Identifier, typename Compare, typename Creator, typename Destructor>
std::vector<Identifier> Factory<AbstractClass, Identifier, Compare, Creator, Destructor>::getIdentifiers() {
    std::lock_guard<std::mutex> lock(mutex_);
    std::vector<Identifier> ids;
    for (auto& entry : creators_) ids.push_back(entry.first);
    return ids;
}
template <class AbstractClass, typename Identifier, typename Compare, typename Creator, typename Destructor>
Properties
Factory<AbstractClass, Identifier, Compare, Creator, Destructor>::getProperties(const Identifier& id) {
    std::lock_guard<std::mutex> lock(mutex_);
    auto found = creators_.find(id);
    return found == creators_.end() ? Properties() : found->second.properties;
}
template <class AbstractClass, typename Identifier, typename Compare, typename Creator, typename Destructor>
FactoryReturn Factory<AbstractClass, Identifier, Compare, Creator, Destructor>::addFactory(
    const Identifier& id, Creator creator, Destructor destructor, Properties properties) {
    if (!creator || !destructor) return FactoryReturn::INVALID_ARG;
    std::lock_guard<std::mutex> lock(mutex_);
    bool added = creators_.emplace(id, Entry{id, creator, destructor, properties}).second;
    return added ? FactoryReturn::OK : FactoryReturn::ALREADY_EXISTS;
}
template <class AbstractClass, typename Identifier, typename Compare, typename Creator, typename Destructor>
FactoryReturn
Factory<AbstractClass, Identifier, Compare, Creator, Destructor>::removeFactory(const Identifier& id) {
    std::lock_guard<std::mutex> lock(mutex_);
    return creators_.erase(id) ? FactoryReturn::OK : FactoryReturn::NOT_FOUND;
}
template <class AbstractClass, typename Identifier, typename Compare, typename Creator, typename Destructor>
AbstractClass*
Factory<AbstractClass, Identifier, Compare, Creator, Destructor>::createObject(const Identifier& id) {
    std::lock_guard<std::mutex> lock(mutex_);
    auto found = creators_.find(id);
    if (found == creators_.end()) return nullptr;
    AbstractClass* object = found->second.creator();
    if (object != nullptr) objects_.emplace(object, found->second);
    return object;
}
template <class AbstractClass, typename Identifier, typename Compare, typename Creator, typename Destructor>
FactoryReturn
Factory<AbstractClass, Identifier, Compare, Creator, Destructor>::deleteObject(AbstractClass*& object) {
    std::lock_guard<std::mutex> lock(mutex_);
    auto found = objects_.find(object);
    if (found == objects_.end()) return FactoryReturn::NOT_FOUND;
    Destructor destroy = found->second.destructor;
    objects_.erase(found);
    destroy(object);
    return FactoryReturn::OK;
}
template <class AbstractClass, typename Identifier, typename Compare, typename Creator, typename Destructor>
std::vector<AbstractClass*>
Factory<AbstractClass, Identifier, Compare, Creator, Destructor>::createdObjects() {
    std::lock_guard<std::mutex> lock(mutex_);
    std::vector<AbstractClass*> objects;
    for (auto& entry : objects_) objects.push_back(entry.first);
    return objects;
}
template <class AbstractClass, typename Identifier, typename Compare, typename Creator, typename Destructor>
bool Factory<AbstractClass, Identifier, Compare, Creator, Destructor>::isProducerOf(AbstractClass* object) {
    std::lock_guard<std::mutex> lock(mutex_);
    return objects_.count(object) != 0;
}
template <class AbstractClass, typename Identifier, typename Compare, typename Creator, typename Destructor>
FactoryReturn
Factory<AbstractClass, Identifier, Compare, Creator, Destructor>::objectToIdentifier(AbstractClass* object,
                                                                                     Identifier& id) {
    std::lock_guard<std::mutex> lock(mutex_);
    auto found = objects_.find(object);
    if (found == objects_.end()) return FactoryReturn::NOT_FOUND;
    id = found->second.id;
    return FactoryReturn::OK;
}

/// The factory of a class, shared by all libraries of the process. Tandem's library instantiates it explicitly, so
/// that there is one instance.
template <class AbstractClass, typename Identifier = std::string, typename Compare = std::less<Identifier>,
          typename Creator = AbstractClass* (*)(), typename Destructor = void (*)(AbstractClass*&)>
class GlobalFactory : public Factory<AbstractClass, Identifier, Compare, Creator, Destructor> {
  public:
    // Never destroyed: objects may be returned to it while the process exits.
    static GlobalFactory& instance() {
        static GlobalFactory* the_instance = new GlobalFactory();
        return *the_instance;
    }
    GlobalFactory(const GlobalFactory&) = delete;
    GlobalFactory& operator=(const GlobalFactory&) = delete;

  private:
    GlobalFactory() = default;
};

} // namespace coil
#endif
