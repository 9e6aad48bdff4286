using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Has matter push a rigid body, which pushes matter by its <see cref="PbmpmCollider"/>. Let the world step in FixedUpdate.
    /// Unity moves the body: gravity, joints and contacts with other bodies are its own.</summary>
    [AddComponentMenu("pbmpm/Rigidbody coupling")]
    [RequireComponent(typeof(Rigidbody), typeof(PbmpmCollider))]
    public sealed class PbmpmRigidbody : MonoBehaviour
    {
        Rigidbody body;
        Vector3 lastChange;

        /// <summary>What matter gave in the last step [N s].</summary>
        public Vector3 Impulse { get; private set; }

        /// <summary>Share of its volume that is under matter, 0 to 1.</summary>
        public float Submerged { get; private set; }

        void Awake()
        {
            body = GetComponent<Rigidbody>();
        }

        /// <summary>Where the body's motion takes it within a step.</summary>
        internal void Aim(float seconds, ref Placement place)
        {
            var centre = body.worldCenterOfMass;
            var turned = Places.Turned(body.rotation, body.angularVelocity, seconds);
            var arm = body.position - centre;
            var carried = turned * Quaternion.Inverse(body.rotation) * arm;
            place.Position = centre + Velocity * seconds + carried;
            place.Rotation = turned;
        }

        /// <summary>Gives the body what matter gave to its obstacle. Light bodies would swing more and more, since matter feels them a step
        /// late. So changes of velocity are smoothed by a virtual mass, as include/pbmpm/rigid.h derives. Gravity is Unity's own.</summary>
        internal void Take(Impulse given, Submersion under, Vector3 place, float seconds)
        {
            Impulse = Places.Of(given.Linear);
            Submerged = (float)under.Share;
            var fall = body.useGravity ? Physics.gravity * seconds : Vector3.zero;
            var share = (float)(under.Density * under.Volume) / body.mass * Submerged;
            var change = (Impulse / body.mass + fall + lastChange * share) / (1 + share);
            lastChange = change;
            body.AddForce(change - fall, ForceMode.VelocityChange);
            var turn = Places.Of(given.Angular) + Vector3.Cross(place - body.worldCenterOfMass, Impulse);
            body.AddTorque(turn, ForceMode.Impulse);
        }

        void OnDisable()
        {
            lastChange = Vector3.zero;
        }

        Vector3 Velocity
        {
            get
            {
#if UNITY_6000_0_OR_NEWER
                return body.linearVelocity;
#else
                return body.velocity;
#endif
            }
        }
    }
}
