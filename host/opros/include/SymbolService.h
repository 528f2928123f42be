// SPDX-License-Identifier: Apache-2.0
// Variables that a component exports to tools by name.
#ifndef SYMBOLSERVICE_H_
#define SYMBOLSERVICE_H_

#include <Component.h>
#include <InputDataPort.h>
#include <InputEventPort.h>
#include <OPRoSTypes.h>
#include <OutputDataPort.h>
#include <OutputEventPort.h>
#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>
#include <RequiredMethod.h>
#include <RequiredServicePort.h>
#include <archive/opros_archive.h>

enum SymbolEncodingRule : int { OPROS_SYMBOL_ENCODING_STR = 0, OPROS_SYMBOL_ENCODING_BIN = 1 };

/// Access to one variable of any type, in the calling thread and without a lock. The component may change the
/// variable at the same time.
class SymbolObject {
  public:
    virtual ~SymbolObject() {}
    virtual void getValue(opros::archive::oarchive& ar) = 0;
    virtual void setValue(opros::archive::iarchive& ar) = 0;
};

template <typename T>
class SymbolAccessObject : public SymbolObject {
  public:
    explicit SymbolAccessObject(T* p) : m_p(p) {}
    virtual void getValue(opros::archive::oarchive& ar) { ar << *m_p; }
    virtual void setValue(opros::archive::iarchive& ar) { ar >> *m_p; }

  private:
    T* m_p;
};

/// Returns a new object for the variable, which must outlive the component's ports.
template <typename T>
SymbolObject* makeSymbolObject(T* p) {
    return new SymbolAccessObject<T>(p);
}

/// Exports the variable under this name on the component's provided port "opros.symbol", which the first call creates.
/// Takes ownership of the object. Returns OPROS_BAD_INPUT_PARAMETER for NULL. Call it in the constructor or
/// onInitialize(). [main-thread]
ReturnType symbolservice_exportSymbol(Component* comp, const std::string& name, SymbolObject* p);

/// Exports the variable b under the name a. For use in a member function of the component.
#define EXPORT_VARIABLE(a, b) (symbolservice_exportSymbol(this, a, makeSymbolObject(&b)))

#endif
