// SPDX-License-Identifier: Apache-2.0
// A stand-in for the few classes of GMAT that the plugin uses: the same names, what the plugin
// needs of their members, and a sky and spacecraft that a test sets. It is not GMAT and has none of
// its code; tests/gmat runs the plugin in the real one.
#ifndef SRP_TESTS_GMAT_STAND_IN_HPP
#define SRP_TESTS_GMAT_STAND_IN_HPP

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

typedef int Integer;
typedef unsigned int UnsignedInt;
typedef double Real;
typedef std::vector<Integer> IntegerArray;
typedef std::vector<std::string> StringArray;

namespace Gmat {
const UnsignedInt PHYSICAL_MODEL = 112, COORDINATE_SYSTEM = 121, ATTITUDE = 129, ODE_MODEL = 130;
enum ParameterType { INTEGER_TYPE, REAL_TYPE, STRING_TYPE, BOOLEAN_TYPE, FILENAME_TYPE };
enum StateElementId {
    CARTESIAN_STATE = 3700,
    ORBIT_STATE_TRANSITION_MATRIX = 3702,
    ORBIT_A_MATRIX = 3703,
    MASS_FLOW = 3705
};
} // namespace Gmat

class Rvector6 {
  public:
    Rvector6() : Rvector6(0, 0, 0, 0, 0, 0) {
    }
    Rvector6(Real a, Real b, Real c, Real d, Real e, Real f) : v{a, b, c, d, e, f} {
    }
    Real operator[](Integer i) const {
        return v[i];
    }

  private:
    Real v[6];
};

class Rmatrix33 {
  public:
    Real m[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Real operator()(Integer i, Integer j) const {
        return m[i][j];
    }
};

class ODEModelException : public std::runtime_error {
  public:
    explicit ODEModelException(const std::string &details) : std::runtime_error(details) {
    }
};

class MessageReceiver {
  public:
    std::string text;
};

class MessageInterface {
  public:
    static void SetMessageReceiver(MessageReceiver *receiver) {
        to() = receiver;
    }
    static void ShowMessage(const char *format, ...);
    static MessageReceiver *&to();
};

class FileManager {
  public:
    static FileManager *Instance();
    std::string GetGmatWorkingDirectory() {
        return directory;
    }
    std::string directory;
};

class GmatBase {
  public:
    GmatBase(UnsignedInt, const std::string &type, const std::string &name)
        : typeName(type), instanceName(name), parameterCount(0), isInitialized(false) {
    }
    virtual ~GmatBase() {
    }
    virtual GmatBase *Clone() const = 0;
    virtual bool HasLocalClones() = 0;
    virtual bool RenameRefObject(const UnsignedInt, const std::string &, const std::string &) = 0;
    std::string GetName() const {
        return instanceName;
    }
    virtual std::string GetTypeName() const {
        return typeName;
    }
    virtual GmatBase *GetRefObject(const UnsignedInt, const std::string &) {
        return nullptr;
    }
    virtual std::string GetRefObjectName(const UnsignedInt) const {
        return "";
    }

    virtual std::string GetParameterText(const Integer id) const;
    virtual Integer GetParameterID(const std::string &label) const;
    virtual Gmat::ParameterType GetParameterType(const Integer id) const;
    virtual std::string GetParameterTypeString(const Integer id) const;
    virtual Real GetRealParameter(const Integer id) const;
    virtual Real SetRealParameter(const Integer id, const Real value);
    virtual Real GetRealParameter(const std::string &label) const;
    virtual Real SetRealParameter(const std::string &label, const Real value);
    virtual Integer GetIntegerParameter(const Integer id) const;
    virtual Integer SetIntegerParameter(const Integer id, const Integer value);
    virtual Integer GetIntegerParameter(const std::string &label) const;
    virtual Integer SetIntegerParameter(const std::string &label, const Integer value);
    virtual bool GetBooleanParameter(const Integer id) const;
    virtual bool SetBooleanParameter(const Integer id, const bool value);
    virtual bool GetBooleanParameter(const std::string &label) const;
    virtual bool SetBooleanParameter(const std::string &label, const bool value);
    virtual std::string GetStringParameter(const Integer id) const;
    virtual bool SetStringParameter(const Integer id, const std::string &value);
    virtual std::string GetStringParameter(const std::string &label) const;
    virtual bool SetStringParameter(const std::string &label, const std::string &value);
    Integer GetParameterCount() const {
        return parameterCount;
    }

    static const std::string PARAM_TYPE_STRING[];

  protected:
    std::string typeName, instanceName;
    StringArray objectTypeNames;
    Integer parameterCount;
    bool isInitialized;
    enum { GmatBaseParamCount = 4 };
};

// Moves uniformly.
class CelestialBody : public GmatBase {
  public:
    CelestialBody(const std::string &name, Rvector6 at, Real radius_km)
        : GmatBase(0, "CelestialBody", name), state(at), radius(radius_km) {
    }
    GmatBase *Clone() const {
        return new CelestialBody(*this);
    }
    bool HasLocalClones() {
        return false;
    }
    bool RenameRefObject(const UnsignedInt, const std::string &, const std::string &) {
        return true;
    }
    Rvector6 GetState(Real a1mjd) const;
    Real GetEquatorialRadius() const {
        return radius;
    }

    Rvector6 state; // at A1 modified Julian date 0 [km, km/day]
    Real radius;
};

class SolarSystem {
  public:
    CelestialBody *GetBody(const std::string &name) {
        const auto found = bodies.find(name);
        return found == bodies.end() ? nullptr : found->second;
    }
    std::map<std::string, CelestialBody *> bodies;
};

class GmatState {
  public:
    Real *GetState() {
        return values;
    }
    Real values[6] = {0, 0, 0, 0, 0, 0};
};

class CoordinateSystem : public GmatBase {
  public:
    CoordinateSystem() : GmatBase(Gmat::COORDINATE_SYSTEM, "CoordinateSystem", "EarthMJ2000Eq") {
    }
    GmatBase *Clone() const {
        return new CoordinateSystem(*this);
    }
    bool HasLocalClones() {
        return false;
    }
    bool RenameRefObject(const UnsignedInt, const std::string &, const std::string &) {
        return true;
    }
    bool AreAxesOfType(const std::string &type) const {
        return std::find(axes.begin(), axes.end(), type) != axes.end();
    }

    StringArray axes{"InertialAxes", "MJ2000EqAxes"};
};

// Of any kind, which decides nothing here: a test says what it is.
class Attitude : public GmatBase {
  public:
    explicit Attitude(const std::string &kind) : GmatBase(Gmat::ATTITUDE, kind, "") {
    }
    GmatBase *Clone() const {
        return new Attitude(*this);
    }
    bool HasLocalClones() {
        return false;
    }
    bool RenameRefObject(const UnsignedInt, const std::string &, const std::string &) {
        return true;
    }
    std::string GetRefObjectName(const UnsignedInt type) const {
        return type == Gmat::COORDINATE_SYSTEM ? system.GetName() : "";
    }
    GmatBase *GetRefObject(const UnsignedInt type, const std::string &name) {
        return type == Gmat::COORDINATE_SYSTEM && name == system.GetName() ? &system : nullptr;
    }
    Real GetRealParameter(const std::string &label) const {
        return real.at(label);
    }
    void BecomeKind(const std::string &kind) {
        typeName = kind;
    }

    CoordinateSystem system;
    std::map<std::string, Real> real; // AngularVelocityX to Z [deg/s]
};

class Spacecraft : public GmatBase {
  public:
    explicit Spacecraft(const std::string &name) : GmatBase(0, "Spacecraft", name) {
    }
    GmatBase *GetRefObject(const UnsignedInt type, const std::string &) {
        return type == Gmat::ATTITUDE ? &kind : nullptr;
    }
    GmatBase *Clone() const {
        return new Spacecraft(*this);
    }
    bool HasLocalClones() {
        return false;
    }
    bool RenameRefObject(const UnsignedInt, const std::string &, const std::string &) {
        return true;
    }
    const Rmatrix33 &GetAttitude(Real a1mjd) {
        asked_at = a1mjd;
        ++asked;
        return attitude;
    }
    Real GetEpoch() const {
        return epoch;
    }
    GmatState &GetState() {
        return state;
    }
    Real GetRealParameter(const std::string &label) const {
        return real.at(label);
    }
    Integer GetIntegerParameter(const std::string &label) const {
        return whole.at(label);
    }

    Attitude kind{"NadirPointing"};
    Rmatrix33 attitude;
    Real epoch = 0.0, asked_at = 0.0;
    int asked = 0; // how often for its attitude
    GmatState state;
    std::map<std::string, Real> real;
    std::map<std::string, Integer> whole;
};

class PhysicalModel : public GmatBase {
  public:
    PhysicalModel(UnsignedInt id, const std::string &type, const std::string &name);
    PhysicalModel(const PhysicalModel &other);
    PhysicalModel &operator=(const PhysicalModel &other);
    virtual ~PhysicalModel();

    virtual bool Initialize();
    virtual void SetForceOrigin(CelestialBody *to) {
        forceOrigin = to;
    }
    virtual void SetSolarSystem(SolarSystem *to) {
        solarSystem = to;
    }
    virtual void SetDimension(Integer n) {
        dimension = n;
    }
    virtual void SetTime(Real seconds) {
        elapsedTime = seconds;
    }
    void SetEpoch(Real a1mjd) {
        epoch = a1mjd;
    }
    const Real *GetDerivativeArray() const {
        return deriv;
    }
    virtual bool GetDerivatives(Real *, Real = 0.0, Integer = 1, const Integer = -1) {
        return false;
    }
    virtual Rvector6 GetDerivativesForSpacecraft(Spacecraft *) {
        return Rvector6();
    }
    virtual void SetSatelliteParameter(const Integer, const std::string, const Real,
                                       const Integer = -1) {
    }
    virtual void SetSatelliteParameter(const Integer, Integer, const Real) {
    }
    virtual void SetSatelliteParameter(const Integer, const std::string, const std::string) {
    }
    virtual void SetSpaceObject(const Integer i, GmatBase *object);
    virtual void ClearSatelliteParameters(const std::string = "") {
    }
    virtual bool AttitudeAffectsDynamics() {
        return false;
    }
    virtual bool IsUserForce() {
        return false;
    }
    virtual bool IsUnique(const std::string & = "") {
        return false;
    }
    virtual bool SupportsDerivative(Gmat::StateElementId id) {
        return id == Gmat::CARTESIAN_STATE;
    }
    virtual bool SetStart(Gmat::StateElementId, Integer, Integer, Integer) {
        return false;
    }
    virtual bool BuildModelState(Real now, Real *state, Real *j2kState, Integer dimension = 6);

  protected:
    CelestialBody *body, *forceOrigin;
    Integer dimension;
    Real epoch, elapsedTime;
    Real *deriv;
    IntegerArray derivativeIds;
    SolarSystem *solarSystem;
    bool fillCartesian;
    Integer cartesianStart, cartesianCount;
    bool fillSTM;
    Integer stmStart, stmCount;
    bool fillAMatrix;
    Integer aMatrixStart, aMatrixCount;
    bool isConservative;
    std::vector<GmatBase *> scObjs;
    enum { PhysicalModelParamCount = GmatBaseParamCount + 4 };
};

class ODEModel : public PhysicalModel {
  public:
    explicit ODEModel(const std::string &name)
        : PhysicalModel(Gmat::ODE_MODEL, "ForceModel", name) {
    }
    GmatBase *Clone() const {
        return new ODEModel(*this);
    }
    bool HasLocalClones() {
        return false;
    }
    bool RenameRefObject(const UnsignedInt, const std::string &, const std::string &) {
        return true;
    }
    Integer GetNumForces() {
        return Integer(forces.size());
    }
    PhysicalModel *GetForce(Integer i) const {
        return forces[size_t(i)];
    }
    std::vector<PhysicalModel *> forces;
};

// The objects of the script.
class ConfigManager {
  public:
    static ConfigManager *Instance();
    const StringArray &GetListOfItems(UnsignedInt type);
    GmatBase *GetItem(const std::string &name);
    std::vector<ODEModel *> models;

  private:
    StringArray list;
};

class Factory {
  public:
    explicit Factory(UnsignedInt type) : itemType(type) {
    }
    virtual ~Factory() {
    }
    virtual GmatBase *CreateObject(const std::string &, const std::string &) {
        return nullptr;
    }
    virtual PhysicalModel *CreatePhysicalModel(const std::string &, const std::string &) {
        return nullptr;
    }
    StringArray GetListOfCreatableObjects() const {
        return creatables;
    }

  protected:
    UnsignedInt itemType;
    StringArray creatables;
};

#endif
