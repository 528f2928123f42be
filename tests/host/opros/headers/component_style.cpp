#include <BasicTypes.h>
#include <OPRoSInclude.h>
#include <OSGuard.h>
#include <OSMutex.h>
#include <archive/opros_archive_smart_ptr.h>
#include <device/ApiTypes.h>
#include <device/OprosApi.h>
#include <device/OprosDevice.h>
#include <device/OprosLock.h>
#include <device/OprosPrintMessage.h>
#include <device/OprosTimer.h>
#include <device/Property.h>
#include <stack>
struct P {
    int a;
    double b;
    void save(opros::archive::oarchive& ar, const unsigned int) { ar << OPROS_SERIALIZATION_NVP(a) << b; }
    void load(opros::archive::iarchive& ar, const unsigned int) {
        ar >> OPROS_SERIALIZATION_NVP(a);
        ar& b;
    }
};
inline std::string typeName(P*) { return "P"; }
struct Q {
    std::vector<P> v;
    int m[3];
};
inline std::string typeName(Q*) { return "Q"; }
inline void save_this(opros::archive::oarchive& ar, Q& q) {
    ar << q.v;
    ar << q.m;
}
inline void load_this(opros::archive::iarchive& ar, Q& q) {
    ar >> q.v;
    ar >> q.m;
}
struct N {
    int x;
};
enum Color { red };
struct IX {
    virtual double f(std::string, int) = 0;
    virtual void g() = 0;
    virtual Q h(std::vector<P>, const Q&) = 0;
};
struct XP : ProvidedServicePort, IX {
    IX* pcom;
    typedef ProvidedMethod<double> fT;
    fT* ff;
    ProvidedMethod<void>* gf;
    ProvidedMethod<Q>* hf;
    XP(IX* p) : pcom(p) {
        Method* m = makeProvidedMethod(&IX::f, pcom, "f");
        addMethod("f", m);
        ff = reinterpret_cast<fT*>(m);
        m = makeProvidedMethod(&IX::g, pcom, "g");
        addMethod("g", m);
        gf = reinterpret_cast<ProvidedMethod<void>*>(m);
        m = makeProvidedMethod(&IX::h, pcom, "h");
        addMethod("h", m);
        hf = reinterpret_cast<ProvidedMethod<Q>*>(m);
    }
    double f(std::string s, int i) override { return (*ff)(s, i); }
    void g() override { (*gf)(); }
    Q h(std::vector<P> p, const Q& q) override { return (*hf)(p, q); }
};
struct XR : RequiredServicePort {
    RequiredMethod<double>* ff;
    RequiredMethod<void>* gf;
    RequiredMethod<Q>* hf;
    XR() {
        Method* m = makeRequiredMethod(&XR::f, "f");
        addMethod("f", m);
        ff = reinterpret_cast<RequiredMethod<double>*>(m);
        m = makeRequiredMethod(&XR::g, "g");
        addMethod("g", m);
        gf = reinterpret_cast<RequiredMethod<void>*>(m);
        m = makeRequiredMethod(&XR::h, "h");
        addMethod("h", m);
        hf = reinterpret_cast<RequiredMethod<Q>*>(m);
    }
    double f(std::string s, int i) { return (*ff)(s, i); }
    void g() { (*gf)(); }
    Q h(std::vector<P> p, const Q& q) { return (*hf)(p, q); }
};
class C : public Component, public IX {
  public:
    InputDataPort<Q> in;
    OutputDataPort<std::vector<P>> out;
    InputDataPort<N> n;
    InputDataPort<JoystickData> jd;
    InputDataPort<std::vector<ObjectPosition>> op;
    InputDataPort<OPRoS::Float64Array> oa;
    InputDataPort<std::vector<N>> vn;
    InputDataPort<Color> col;
    InputDataPort<std::map<std::string, std::vector<double>>> mm;
    InputDataPort<opros::smart_ptr<P>> sp;
    InputDataPort<std::vector<bool>> vb;
    InputDataPort<std::stack<int>> st;
    InputDataPort<std::valarray<double>> va;
    InputDataPort<Property> pr;
    InputDataPort<std::vector<std::vector<unsigned char>>> vv;
    InputEventPort<Q> ie;
    OutputEventPort<N> oe;
    InputEventPort<std::string> se;
    int v = 0;
    C() : in(OPROS_LAST, 1) {
        addPort("in", &in);
        addPort("x", new XP(this));
        EXPORT_VARIABLE("v", v);
        ie.setOwner(this);
        SET_EVENT_CALLBACK(se, C::onMsg, this);
        SET_EVENT_CALLBACK(ie, C::onEv, this);
    }
    void onMsg(const std::string& id, const std::string& v) {
        (void)id;
        (void)v;
    }
    void onEv(EventData<Q>*) {}
    double f(std::string, int) override { return 1; }
    void g() override {}
    Q h(std::vector<P>, const Q& q) override { return q; }
    ReturnType onExecute() override {
        opros_any* a = in.pop();
        if (a) {
            Q q = in.getContent(*a);
            delete a;
            out.push(q.v);
        }
        std::vector<bool> bb(2);
        std::stringstream ss;
        opros::archive::binary_oarchive ar(&ss);
        ar << bb[1] << "lit" << 3 << red << 'c';
        opros::archive::binary_iarchive ia(&ss);
        ia >> bb[0];
        Color c;
        ia >> c;
        char* p = 0;
        long sz = 0;
        ia.load(&p, sz);
        unsigned char* u = 0;
        const int k = 4;
        ar.save(u, k);
        ia.load(&u, 5);
        EventData<std::string> e;
        e.setContentData("x");
        EventData<std::string> e2(e);
        e2 = e;
        return OPROS_SUCCESS;
    }
};
static_assert(opros::archive::is_serializable<std::vector<P>>::value, "");
static_assert(!opros::archive::is_serializable<std::vector<N>>::value, "");
static_assert(opros::archive::is_serializable<std::map<std::string, Q>>::value, "");
static_assert(!opros::archive::is_serializable<std::map<std::string, N>>::value, "");
static_assert(!opros::archive::is_serializable<int*>::value, "");
extern "C" Component* getComponent() { return new C; }
