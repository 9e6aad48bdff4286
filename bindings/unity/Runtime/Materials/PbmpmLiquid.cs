using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Keeps its volume: water, oil, honey.</summary>
    [CreateAssetMenu(menuName = "pbmpm/Liquid", fileName = "Liquid")]
    public sealed class PbmpmLiquid : PbmpmMaterial
    {
        [Tooltip("Kinematic viscosity [m^2/s], 0 to 1e6. Water has 1e-6, honey 5e-3.")]
        public float viscosity;

        [Tooltip("Bulk modulus [Pa]; 0: incompressible.")]
        public float bulkModulus;

        protected override void Describe(ref MaterialDef definition)
        {
            definition.Kind = MaterialKind.Liquid;
            definition.KinematicViscosity = viscosity;
            definition.BulkModulus = bulkModulus;
        }
    }
}
