using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Shears as far as friction lets it, and bears no tension: sand, snow, grain.</summary>
    [CreateAssetMenu(menuName = "pbmpm/Sand", fileName = "Sand")]
    public sealed class PbmpmSand : PbmpmStiffMaterial
    {
        [Tooltip("Angle of inner friction [degrees], 0 to 80.")]
        public float frictionAngle = 30;

        [Tooltip("Logarithm of the volume ratio up to which it bears tension, 0 to 0.5; 0: dry.")]
        public float cohesion;

        protected override void DescribeFlow(ref MaterialDef definition)
        {
            definition.Kind = MaterialKind.Sand;
            definition.FrictionAngle = frictionAngle * Mathf.Deg2Rad;
            definition.Cohesion = cohesion;
        }
    }
}
