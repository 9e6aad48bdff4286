using System.Collections;
using NUnit.Framework;
using Pbmpm.Components;
using UnityEngine;
using UnityEngine.TestTools;

namespace Pbmpm.Tests
{
    public sealed class PartTests : StageTests
    {
        [Test]
        public void FillsLeaveRoomForObstacles()
        {
            stage.AddPool(); // joins before the obstacle
            var obstacle = stage.Add<PbmpmCollider>(new Vector3(0, -0.5f, 0));
            obstacle.shape.SetBox(Vector3.zero, Vector3.one);
            stage.Begin();
            Assert.AreEqual(12288, stage.World.ParticleCount);
        }

        [Test]
        public void ObstaclesFollowTheirTransform()
        {
            var obstacle = stage.Add<PbmpmCollider>(Vector3.zero);
            obstacle.shape.SetCapsule(new Vector3(0, 0.1f, 0), 0.1f, 0.6f);
            stage.Begin();
            stage.Step(1);
            obstacle.transform.position = new Vector3(0.05f, 0, 0);
            obstacle.transform.rotation = Quaternion.AngleAxis(30, Vector3.forward);
            stage.Step(1);
            var now = stage.World.Simulation.ShapeOf(obstacle.Id);
            // Unity's capsules stand upright, the library's lie along x: a quarter turn more
            Near(new Vector3(0.05f - 0.1f * Mathf.Sin(30 * Mathf.Deg2Rad), 0.1f * Mathf.Cos(30 * Mathf.Deg2Rad), 0), now.Position);
            Assert.AreEqual(Mathf.Sin(60 * Mathf.Deg2Rad), now.Rotation.Z, 1e-5f);
            Assert.AreEqual(0.2f, now.HalfExtents.X, 1e-6f);
            obstacle.transform.localScale = new Vector3(2, 2, 2);
            stage.Step(1);
            Assert.AreEqual(0.2f, stage.World.Simulation.ShapeOf(obstacle.Id).Radius, 1e-6f);
        }

        [Test]
        public void AnObstacleThatIsDisabledLeaves()
        {
            var obstacle = stage.Add<PbmpmCollider>(Vector3.zero);
            stage.Begin();
            stage.Step(1);
            var id = obstacle.Id;
            Assert.IsTrue(stage.World.Simulation.IsValid(id));
            obstacle.enabled = false;
            Assert.IsTrue(!stage.World.Simulation.IsValid(id));
            obstacle.enabled = true;
            stage.Step(1);
            Assert.IsTrue(obstacle.IsIn);
        }

        [Test]
        public void MatterComesAndGoes()
        {
            var tap = stage.Add<PbmpmEmitter>(new Vector3(0, 0.5f, 0));
            tap.material = stage.Water;
            tap.shape.radius = 0.2f;
            var drain = stage.Add<PbmpmDrain>(new Vector3(0, -0.9f, 0));
            drain.shape.SetBox(Vector3.zero, new Vector3(2, 0.2f, 2));
            stage.Begin();
            stage.Step(60);
            Assert.AreEqual(Mathf.PI * 0.04f * 1000, (float)tap.Status.EmittedMass, 1);
            Assert.Greater((float)drain.Status.DrainedMass, 1);
            tap.runs = false;
            tap.Change();
            stage.Step(1);
            var emitted = tap.Status.Emitted;
            stage.Step(2);
            Assert.AreEqual(emitted, tap.Status.Emitted);
        }

        [Test]
        public void ForcesFollowTheirTransform()
        {
            stage.World.gravity = Vector3.zero;
            stage.AddBlock(stage.Water);
            var wind = stage.Add<PbmpmForce>(Vector3.zero);
            wind.everywhere = true;
            wind.strength = 6;
            stage.Begin();
            stage.Step(1);
            wind.transform.rotation = Quaternion.AngleAxis(-90, Vector3.forward);
            stage.Step(1);
            var stats = stage.World.Simulation.Stats;
            Near(new Vector3(0.1f, 0.1f, 0), new Vector3((float)(stats.Momentum.X / stats.Mass), (float)(stats.Momentum.Y / stats.Mass), 0));
        }

        [UnityTest]
        public IEnumerator LightBodiesFloatAndHeavyOnesSink()
        {
            stage.World.pace = Pace.FixedUpdate;
            stage.AddPool();
            var light = AddBody(new Vector3(-0.45f, 0.3f, 0), 300);
            var heavy = AddBody(new Vector3(0.45f, 0.3f, 0), 3000);
            stage.Begin();
            float height = 0, under = 0;
            var frames = 0;
            while (stage.World.Statistics.SimulatedSeconds < 3)
            {
                yield return null;
                if (stage.World.Statistics.SimulatedSeconds < 2) continue;
                height += light.transform.position.y;
                under += light.Submerged;
                frames++;
            }
            // Archimedes: three tenths are under; both bodies lift the level by 0.13 / 4 m. Within half a cell
            Assert.AreEqual(0.033f + 0.2f - 0.12f, height / frames, 0.0625f);
            Assert.AreEqual(0.3f, under / frames, 0.0625f / 0.4f);
            Assert.Less(heavy.transform.position.y, -0.4f);
        }

        [Test]
        public void SolidsAreBakedOnceAndShared()
        {
            var solid = ScriptableObject.CreateInstance<PbmpmSolid>();
            solid.mesh = Cube();
            solid.scale = new Vector3(0.5f, 0.5f, 0.75f);
            solid.resolution = 16;
            solid.Bake();
            var fill = stage.AddBlock(stage.Water);
            fill.shape.form = Form.Solid;
            fill.shape.solid = solid;
            var obstacle = stage.Add<PbmpmCollider>(new Vector3(0.5f, 0.5f, 0));
            obstacle.shape.form = Form.Solid;
            obstacle.shape.solid = solid;
            stage.Begin();
            // 8 x 8 x 12 points of a lattice that need not begin at its corner
            Assert.Greater(stage.World.ParticleCount, 7 * 7 * 11 - 1);
            Assert.Less(stage.World.ParticleCount, 9 * 9 * 13 + 1);
            Assert.AreEqual(stage.World.Simulation.ShapeOf(obstacle.Id).Baked, stage.World.Loaded(solid));
        }

        [Test]
        public void TerrainRisesWhereItsHeightsDo()
        {
            var rows = new float[5, 5];
            for (var z = 0; z < 5; z++)
                for (var x = 0; x < 5; x++)
                    rows[z, x] = x / 4f;
            var terrain = new TerrainData();
            terrain.SetHeights(0, 0, rows);
            terrain.size = new Vector3(1, 0.8f, 1);
            var solid = ScriptableObject.CreateInstance<PbmpmSolid>();
            solid.terrain = terrain;
            solid.thickness = 0.2f;
            solid.resolution = 20;
            solid.Bake();
            var fill = stage.AddBlock(stage.Water);
            fill.transform.position = new Vector3(-0.5f, -0.5f, -0.5f);
            fill.shape.form = Form.Solid;
            fill.shape.solid = solid;
            stage.Begin();
            var along = Vector3.zero;
            Assert.Greater(stage.World.ParticleCount, 1000);
            var lent = stage.World.Positions;
            for (var i = 0; i < lent.Length; i++) along += lent[i] / lent.Length;
            Assert.Greater(along.x, 0.08f);
            Assert.AreEqual(0, along.z, 0.02f);
        }

        [Test]
        public void FieldsBeginWithTheLibrarysDefaults()
        {
            stage.World.gravity = Vector3.zero;
            stage.Begin();
            Assert.AreEqual(Settings.Default, stage.World.Simulation.Settings);
            Assert.AreEqual(MaterialDef.Default, stage.Water.Definition());
            var elastic = MaterialDef.Default;
            elastic.Kind = MaterialKind.Elastic;
            Assert.AreEqual(elastic, ScriptableObject.CreateInstance<PbmpmElastic>().Definition());
            elastic.Kind = MaterialKind.Visco;
            Assert.AreEqual(elastic, ScriptableObject.CreateInstance<PbmpmVisco>().Definition());
            elastic.Kind = MaterialKind.Sand;
            Assert.AreEqual(elastic.FrictionAngle, ScriptableObject.CreateInstance<PbmpmSand>().Definition().FrictionAngle, 1e-6f);
        }

        PbmpmRigidbody AddBody(Vector3 place, float density)
        {
            var body = stage.Add<PbmpmRigidbody>(place);
            body.GetComponent<PbmpmCollider>().shape.SetBox(Vector3.zero, new Vector3(0.5f, 0.4f, 0.5f));
            body.GetComponent<PbmpmCollider>().frictionCoefficient = 0;
            body.GetComponent<Rigidbody>().mass = density * 0.1f;
            return body;
        }

        static Mesh Cube()
        {
            var corners = new Vector3[8];
            for (var i = 0; i < 8; i++) corners[i] = new Vector3((i & 1) - 0.5f, (i >> 1 & 1) - 0.5f, (i >> 2) - 0.5f);
            return new Mesh
            {
                vertices = corners,
                triangles = new[] { 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 },
            };
        }

        static void Near(Vector3 wanted, Vector3 found)
        {
            Assert.Less((wanted - found).magnitude, 1e-4f, found.ToString());
        }
    }
}
