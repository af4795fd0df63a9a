// SPDX-License-Identifier: Apache-2.0
// The force type HighFidelitySRP of GMAT's force models. It brings the numbers of GMAT (km, km/s^2,
// A1 modified Julian dates, axes MJ2000Eq) to srpcore and back; all physics is there.
#ifndef SRP_PLUGIN_HIGH_FIDELITY_SRP_HPP
#define SRP_PLUGIN_HIGH_FIDELITY_SRP_HPP

#include "AreaModel.hpp"
#include "Attitudes.hpp"
#include "Script.hpp"
#include "Settings.hpp"

#include <srp/acceleration.h>

#include <memory>
#include <string>
#include <vector>

class HighFidelitySRP : public PhysicalModel {
  public:
    explicit HighFidelitySRP(const std::string &name = "");
    HighFidelitySRP(const HighFidelitySRP &other);
    HighFidelitySRP &operator=(const HighFidelitySRP &other);
    virtual ~HighFidelitySRP();

    // What GMAT asks of every object. Methods that some release lacks are not marked `override`.
    virtual GmatBase *Clone() const;
    virtual bool HasLocalClones();
    virtual bool RenameRefObject(const UnsignedInt type, const std::string &oldName,
                                 const std::string &newName);

    // Fields. The other forms stay as they are in the base.
    using PhysicalModel::GetBooleanParameter;
    using PhysicalModel::GetIntegerParameter;
    using PhysicalModel::GetRealParameter;
    using PhysicalModel::GetStringParameter;
    using PhysicalModel::SetBooleanParameter;
    using PhysicalModel::SetIntegerParameter;
    using PhysicalModel::SetRealParameter;
    using PhysicalModel::SetStringParameter;
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

    // The force.
    virtual bool Initialize();
    virtual bool GetDerivatives(Real *state, Real dt = 0.0, Integer order = 1,
                                const Integer id = -1);
    virtual Rvector6 GetDerivativesForSpacecraft(Spacecraft *sc);
    virtual bool SupportsDerivative(Gmat::StateElementId id);
    virtual bool SetStart(Gmat::StateElementId id, Integer index, Integer quantity,
                          Integer totalSize);
    using PhysicalModel::SetSatelliteParameter;
    virtual void SetSatelliteParameter(const Integer i, const std::string parmName, const Real parm,
                                       const Integer parmID = -1);
    virtual void SetSatelliteParameter(const Integer i, Integer parmID, const Real parm);
    virtual void ClearSatelliteParameters(const std::string parmName = "");
    virtual void SetSpaceObject(const Integer i, GmatBase *obj);
    virtual bool IsUserForce();
    virtual bool IsUnique(const std::string &forBody = "");
    virtual bool AttitudeAffectsDynamics();

  private:
    // Sun and bodies at an instant, relative to the central body [m].
    struct Sky {
        srp_vec3 sun;
        srp_vec3 bodies[SRP_ACCELERATION_BODIES_MAX];
    };

    const srp_plugin::Field *field_of(Integer id) const;
    void changed();
    srp_plugin::Settings with_paths() const;
    srp_plugin::ForceModels force_models() const;
    void find_bodies();
    void find_shadow_bodies();
    Sky sky_at(Real a1mjd);
    void accelerate(const Spacecraft *sc, const Real *r_km, const Sky &sky,
                    srp_acceleration_state *state, srp_vec3 *a, double (*da_dr)[3]);
    Real mass_of(Integer satellite);
    Integer add_partials(Integer satellite, Integer before, const double da_dr[3][3]);

    srp_plugin::Settings settings_;
    // One for all copies, until a field of one of them is set.
    std::shared_ptr<srp_plugin::SharedModel> shared_;

    // From Initialize().
    std::shared_ptr<const srp_plugin::AreaModel> model_;
    srp_acceleration_params params_;
    CelestialBody *sun_;
    std::vector<CelestialBody *> shadow_bodies_;

    // From ODEModel.
    std::vector<Real> masses_;
    Integer mass_id_;
    srp_plugin::Attitudes attitudes_;
    bool introduced_; // whether the notes know the spacecraft
};

#endif
