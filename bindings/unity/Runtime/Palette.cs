using System.Collections.Generic;
using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>The materials that a world has taken in, and their colours by index.</summary>
    internal sealed class Palette
    {
        readonly List<PbmpmMaterial> materials = new List<PbmpmMaterial>();
        readonly List<MaterialId> ids = new List<MaterialId>();
        readonly List<int> revisions = new List<int>();
        readonly Vector4[] colours = new Vector4[Constants.MaxMaterials];

        /// <summary>Counts changes of colours.</summary>
        public int Revision { get; private set; }

        public Vector4[] Colours => colours;

        /// <summary>By which particles name a material. One that is not in the world gets an index that none has.</summary>
        public uint IndexOf(PbmpmMaterial material)
        {
            var known = materials.IndexOf(material);
            return known >= 0 ? ids[known].Index : Constants.MaxMaterials;
        }

        public int Count => materials.Count;
        public PbmpmMaterial MaterialAt(int i) => materials[i];
        public MaterialId IdAt(int i) => ids[i];

        public MaterialId IdOf(PbmpmMaterial material, World world)
        {
            var known = materials.IndexOf(material);
            if (known >= 0) return ids[known];
            var id = world.AddMaterial(material.Definition());
            materials.Add(material);
            ids.Add(id);
            revisions.Add(material.Revision);
            Paint(id, material);
            return id;
        }

        /// <summary>Takes over what was changed in an inspector or by a script.</summary>
        public void Refresh(World world)
        {
            for (var i = 0; i < materials.Count; i++)
            {
                if (revisions[i] == materials[i].Revision) continue;
                world.SetMaterial(ids[i], materials[i].Definition());
                revisions[i] = materials[i].Revision;
                Paint(ids[i], materials[i]);
            }
        }

        public void Clear()
        {
            materials.Clear();
            ids.Clear();
            revisions.Clear();
        }

        void Paint(MaterialId id, PbmpmMaterial material)
        {
            colours[id.Index] = material.color;
            Revision++;
        }
    }
}
